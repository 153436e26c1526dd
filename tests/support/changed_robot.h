#pragma once
/// Shipped robot.yaml files, changed for one test.
#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include "robots/robot_loader.h"
#include "robots/yaml_text.h"
#include "tests/support/paths.h"

namespace sprung::test {

inline std::string shipped_yaml(const std::string& robot) {
  std::ifstream in(test::source_dir() + "/robots/" + robot + "/robot.yaml");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// The same with everything typed out that it says by `all`, `like` and `mirror`.
/// @param file robot.yaml or sim.yaml.
inline std::string typed_out_yaml(const std::string& robot, const std::string& file = "robot.yaml") {
  return yaml_text(YamlMap::load(test::source_dir() + "/robots/" + robot + "/" + file).tree());
}

/// The first `from` becomes `to`; that there is one is expected.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// Number of the line that holds the first `part`, from 1.
inline int line_of(const std::string& text, const std::string& part) {
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return at == std::string::npos
             ? 0
             : 1 + static_cast<int>(
                       std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

/// A robot.yaml whose legs are joints alone: no kinematics, body, gaits or presets, whatever it had.
inline std::string without_feet(const std::string& yaml) {
  std::istringstream in(yaml);
  std::string out, section;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty() && line[0] >= 'a' && line[0] <= 'z') section = line.substr(0, line.find(':'));
    if (section == "body" || section == "gaits" || section == "presets") continue;
    const bool of_feet = section == "legs" &&
                         (line.find("    side:") == 0 || line.find("    links:") == 0 ||
                          line.find("      - {length:") == 0 || line.find("    contact:") == 0 ||
                          line.find("    foot_radius:") == 0);
    if (of_feet) continue;
    const std::size_t at = section == "legs" ? line.find("kinematics:") : std::string::npos;
    out += (at == std::string::npos ? line : line.substr(0, at) + "kinematics: none") + "\n";
  }
  return out;
}

/// A folder with one robot.yaml; gone at the end.
class RobotFolder {
 public:
  RobotFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "sprung_robot_XXXXXX").string();
    const char* made = mkdtemp(pattern.data());
    EXPECT_NE(made, nullptr);
    folder_ = pattern;
  }
  ~RobotFolder() { std::filesystem::remove_all(folder_); }
  RobotFolder(const RobotFolder&) = delete;
  RobotFolder& operator=(const RobotFolder&) = delete;

  std::string yaml_path() const { return (folder_ / "robot.yaml").string(); }
  RobotConfig load(const std::string& yaml) const {
    std::ofstream(yaml_path()) << yaml;
    return load_robot(folder_.string());
  }
  /// What the loader says to it.
  std::string complaint(const std::string& yaml) const {
    try {
      load(yaml);
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "nothing was refused";
  }

 private:
  std::filesystem::path folder_;
};

/// pegasus as it was begun: twelve drives, and legs that are joints alone.
inline RobotConfig pegasus_without_feet() {
  return RobotFolder().load(without_feet(shipped_yaml("pegasus")));
}

}  // namespace sprung::test
