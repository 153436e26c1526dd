#include <gtest/gtest.h>
#include <unistd.h>

#include "lcmtypes/channels.h"
#include "runtime/process_options.h"
#include "runtime/process_status.h"
#include "tests/tools/logs/replay/logged_message.h"
#include "tests/tools/logs/replay/logged_run_fixture.h"
#include "tools/logs/log/writer.h"
#include "tools/logs/recorder/log_metadata.h"
#include "tools/logs/replay/replay_run.h"

namespace sprung {
namespace {

using test::Folder;
using test::message_of;

class LoggedRunTest : public testing::Test {
 protected:
  std::string with_metadata(const char* clock, bool simulation) {
    const std::string path = folder_ / "own.lcm";
    log::Writer writer(path);
    const Bytes bytes = message_bytes(
        make_log_metadata(robot_, {"paper", clock, simulation, 1, 0, 0, "", ""}));
    writer.write(1, channels::kLogMetadata, bytes.data(), bytes.size());
    writer.close();
    return path;
  }
  /// As lcm-logger makes it.
  std::string with_status(std::int64_t configuration_hash, const std::string& robot = "single_leg") {
    const std::string path = folder_ / "lcm-logger.lcm";
    log::Writer writer(path);
    ProcessStatus status;
    status.robot = robot;
    status.clock = "lockstep";
    status.configuration_hash = configuration_hash;
    const Bytes bytes = message_of(status);
    writer.write(1, channels::kProcessStatus, bytes.data(), bytes.size());
    writer.close();
    return path;
  }

  const Folder folder_{"logged-run"};
  const RobotConfig robot_ = load_robot("single_leg");
};

TEST_F(LoggedRunTest, OwnLogIsReplayedWithItsOwnRobotFileAndPreset) {
  const LoggedRun run = read_logged_run(with_metadata("lockstep", true));
  const ReplayRobot with = replay_robot(run, "", "");
  EXPECT_EQ(with.robot.name, "single_leg");
  EXPECT_EQ(with.robot.hash, robot_.hash);
  EXPECT_EQ(with.preset, "paper");
  EXPECT_EQ(with.watchdogs.joint_state_s, robot_.watchdogs.joint_state_s);
  EXPECT_NE(with.source.find("robot.yaml in the log"), std::string::npos);
}

TEST_F(LoggedRunTest, SimulatedDrivesInRealTimeHadLongerWatchdogs) {
  ASSERT_NE(robot_.simulation_watchdogs.joint_state_s, robot_.watchdogs.joint_state_s);
  const ReplayRobot simulated = replay_robot(read_logged_run(with_metadata("realtime", true)), "", "");
  EXPECT_EQ(simulated.watchdogs.joint_state_s, robot_.simulation_watchdogs.joint_state_s);
  const ReplayRobot real = replay_robot(read_logged_run(with_metadata("realtime", false)), "", "");
  EXPECT_EQ(real.watchdogs.joint_state_s, robot_.watchdogs.joint_state_s);
}

TEST_F(LoggedRunTest, AnotherRobotFileOrPresetTakesTheirPlace) {
  const LoggedRun run = read_logged_run(with_metadata("lockstep", true));
  const std::string changed = test::changed_robot("single_leg", "friction_compensation: 0.9",
                                                  "friction_compensation: 0.7", folder_);
  const ReplayRobot with = replay_robot(run, changed, "best");
  EXPECT_EQ(with.preset, "best");
  EXPECT_NE(with.robot.hash, robot_.hash);
  EXPECT_DOUBLE_EQ(with.robot.preset("best").friction_compensation, 0.7);
  EXPECT_EQ(replay_robot(run, "pegasus", "best").robot.name, "pegasus");
}

TEST_F(LoggedRunTest, LogOfLcmLoggerIsKnownByWhatTheProcessesSaid) {
  const LoggedRun run = read_logged_run(with_status(configuration_hash(robot_, "best")));
  EXPECT_FALSE(run.metadata);
  EXPECT_EQ(run.robot, "single_leg");
  EXPECT_EQ(run.clock, "lockstep");
  EXPECT_EQ(replay_robot(run, "", "").preset, "best");
}

TEST_F(LoggedRunTest, RobotFileThatHasChangedSinceIsNotTakenForTheLogs) {
  const LoggedRun run = read_logged_run(with_status(4711));
  try {
    replay_robot(run, "", "");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("--preset"), std::string::npos);
  }
  EXPECT_EQ(replay_robot(run, "", "paper").preset, "paper");
}

TEST_F(LoggedRunTest, LogThatSaysNothingNeedsARobot) {
  log::Writer(folder_ / "empty.lcm").close();
  const LoggedRun run = read_logged_run(folder_ / "empty.lcm");
  try {
    replay_robot(run, "", "");
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("--robot"), std::string::npos);
  }
  EXPECT_THROW(replay_robot(run, "single_leg", "no such preset"), std::invalid_argument);
}

TEST_F(LoggedRunTest, FileThatIsNotThereIsNamed) {
  EXPECT_THROW(read_logged_run(folder_ / "none.lcm"), std::runtime_error);
}

}  // namespace
}  // namespace sprung
