#include "tools/logs/recorder/inprocess_log.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>

#include "robots/robot_loader.h"
#include "runtime/log.h"
#include "tests/support/own_folder.h"
#include "tools/lab/run/scripted_run.h"
#include "tools/logs/log/reader.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kCycles = 100;

class InProcessLogTest : public testing::Test {
 protected:
  InProcessLogTest() : folder_(test::temp_dir() + "inprocess-log") {
    fs::remove_all(folder_);
    InProcessRobot::observe_all_by(logs_into(folder_.string(), "test"));
  }
  ~InProcessLogTest() override {
    InProcessRobot::observe_all_by({});
    fs::remove_all(folder_);
  }
  static RunScript script(const char* robot) {
    RunScript script{load_robot(robot), "best", SimOptions{1, {}, true}, {}, kCycles};
    script.commands.push_back(scripted(OperatorKind::kStand, 10));
    return script;
  }
  static void run(const RunScript& script) {
    run_in_process(
        script, [](const CycleRecord&) {}, [](const OperatorReply&) {});
  }
  std::map<std::string, int> counts(const std::string& name) const {
    std::map<std::string, int> out;
    log::Reader reader((folder_ / name).string());
    for (log::Event event; reader.next(event);) ++out[std::string(event.channel)];
    return out;
  }
  std::string bytes(const std::string& name) const {
    std::ifstream in(folder_ / name, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  }

  const fs::path folder_;
};

TEST_F(InProcessLogTest, EveryCycleOfEveryChannelIsInIt) {
  run(script("single_leg"));
  const auto found = counts("single_leg-000.lcm");
  for (const char* channel :
       {"DRIVE_STATE", "JOINT_STATE", "LEG_COMMAND", "MOTION_STATE", "DRIVE_COMMAND", "SIM_TRUTH"})
    EXPECT_EQ(found.at(channel), kCycles) << channel;
  EXPECT_EQ(found.count("IMU"), 0u);
  EXPECT_EQ(found.at("OPERATOR_COMMAND"), 1);
  EXPECT_EQ(found.at("LOG_METADATA"), 1);
  EXPECT_EQ(found.at("LOG_END"), 1);
}

TEST_F(InProcessLogTest, RobotWithAnImuHasItsSamples) {
  run(script("pegasus"));
  EXPECT_GE(counts("pegasus-000.lcm").at("IMU"), kCycles - 1);
}

TEST_F(InProcessLogTest, EachRobotHasALogAndTheSameRunTheSameBytes) {
  run(script("single_leg"));
  run(script("single_leg"));
  EXPECT_GT(bytes("single_leg-000.lcm").size(), 10'000u);
  EXPECT_EQ(bytes("single_leg-000.lcm"), bytes("single_leg-001.lcm"));
}

TEST_F(InProcessLogTest, MotionThatNoPlannerMakesHasNoMotionState) {
  RunScript own = script("single_leg");
  own.commands.clear();
  own.command_legs_by = [](const JointState& state, LegCommand& command) { command.stamp = state.stamp; };
  run(own);
  const auto found = counts("single_leg-000.lcm");
  EXPECT_EQ(found.count("MOTION_STATE"), 0u);
  EXPECT_EQ(found.at("LEG_COMMAND"), kCycles);
}

TEST_F(InProcessLogTest, LogThatTheDiskDoesNotTakeWholeIsToldOnStandardError) {
  const auto refuse = std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  rlimit small = before;
  small.rlim_cur = 50'000;
  start_log("test");
  testing::internal::CaptureStderr();
  setrlimit(RLIMIT_FSIZE, &small);
  run(script("single_leg"));
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, refuse);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find("the log is not whole"), std::string::npos) << said;
  EXPECT_NE(said.find("single_leg-000.lcm"), std::string::npos) << said;
}

TEST_F(InProcessLogTest, LogsAreOnlyMadeWhereAsked) {
  InProcessRobot::observe_all_by({});
  run(script("single_leg"));
  EXPECT_TRUE(fs::is_empty(folder_));
}

}  // namespace
}  // namespace sprung
