#pragma once
/// A run in this process and its log, made once for all tests of a program.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "robots/robot_loader.h"
#include "signals/operator.h"
#include "tests/support/own_folder.h"
#include "tools/lab/run/scripted_run.h"
#include "tools/logs/recorder/inprocess_log.h"

namespace sprung::test {

using Folder = OwnFolder;

/// Logs of every robot that is made in this process as long as it lives.
class LogsOf {
 public:
  explicit LogsOf(const std::string& folder) { InProcessRobot::observe_all_by(logs_into(folder, "test")); }
  ~LogsOf() { InProcessRobot::observe_all_by({}); }
  LogsOf(const LogsOf&) = delete;
  LogsOf& operator=(const LogsOf&) = delete;
};

/// single_leg stands up and jumps once.
inline RunScript jump_script_of(const RobotConfig& robot, std::int64_t cycles = 2600) {
  RunScript script{robot, "best", SimOptions{3, {}, true}, {}, cycles};
  script.commands.push_back(scripted(OperatorKind::kStand, 50));
  OperatorCommand jump = scripted(OperatorKind::kJump, 1500);
  jump.jump_count = 1;
  script.commands.push_back(jump);
  return script;
}

inline void run(const RunScript& script) {
  run_in_process(
      script, [](const CycleRecord&) {}, [](const OperatorReply&) {});
}

/// A copy of a robot's file in which one text stands for another. @return its path.
inline std::string changed_robot(const std::string& robot, const std::string& from, const std::string& to,
                                 const Folder& folder) {
  std::ifstream in(load_robot(robot).folder + "/robot.yaml");
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  const std::string path = folder / "changed.yaml";
  std::ofstream(path) << text;
  return path;
}

}  // namespace sprung::test
