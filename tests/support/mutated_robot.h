#pragma once
/// A shipped robot with one number of its robot.yaml changed, read by the loader like any other.
#include <stdlib.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "robots/robot_loader.h"
#include "tests/support/changed_robot.h"
#include "tests/support/paths.h"

namespace sprung::test {

/// "joints[3].position.min" in the parsed file. @throws std::runtime_error where the path leads nowhere,
/// naming it.
inline YAML::Node node_at(const YAML::Node& root, const std::string& path) {
  YAML::Node node = root;
  for (std::size_t at = 0; at < path.size();) {
    const std::size_t end = std::min(path.find_first_of(".[", at), path.size());
    if (path[at] == '[') {
      const std::size_t close = path.find(']', at);
      node.reset(node[std::stoul(path.substr(at + 1, close - at - 1))]);
      at = close + 1;
    } else if (end > at) {
      const YAML::Node& parent = node;  // const: else a key that is missing would be made
      const YAML::Node child = parent[path.substr(at, end - at)];
      if (!child.IsDefined()) return child;
      node.reset(child);
      at = end;
    }
    if (at < path.size() && path[at] == '.') ++at;
  }
  return node;
}

/// The file with another value at `path`; where an optional key is not there it is added to its map (of one
/// key a line).
inline std::string with_value(const std::string& yaml, const std::string& path, const std::string& value) {
  const YAML::Node root = YAML::Load(yaml);
  const YAML::Node found = node_at(root, path);
  if (found.IsDefined()) {
    const auto at = static_cast<std::size_t>(found.Mark().pos);
    if (yaml.compare(at, found.Scalar().size(), found.Scalar()) != 0)
      throw std::runtime_error(path + ": found at a wrong place");
    return std::string(yaml).replace(at, found.Scalar().size(), value);
  }
  const std::size_t dot = path.rfind('.');
  const YAML::Node parent = node_at(root, path.substr(0, dot));
  const YAML::Mark first = parent.begin()->first.Mark();
  const std::string line = "\n" + std::string(static_cast<std::size_t>(first.column), ' ') +
                           path.substr(dot + 1) + ": " + value;
  return std::string(yaml).insert(yaml.find('\n', static_cast<std::size_t>(first.pos)), line);
}

/// Its folder, with the shipped plant; gone at the end.
class MutatedRobot {
 public:
  explicit MutatedRobot(const std::string& robot) : yaml_(typed_out_yaml(robot)) {
    std::string pattern = (std::filesystem::temp_directory_path() / "sprung_mutant_XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
    for (const char* file : {"sim.yaml", "model.xml"})
      std::filesystem::create_symlink(test::source_dir() + "/robots/" + robot + "/" + file, folder_ / file);
  }
  ~MutatedRobot() { std::filesystem::remove_all(folder_); }
  MutatedRobot(const MutatedRobot&) = delete;
  MutatedRobot& operator=(const MutatedRobot&) = delete;

  RobotConfig with(const std::string& path, const std::string& value) const {
    std::ofstream(folder_ / "robot.yaml") << with_value(yaml_, path, value);
    return load_robot(folder_.string());
  }

 private:
  std::string yaml_;  ///< the shipped one, typed out
  std::filesystem::path folder_;
};

}  // namespace sprung::test
