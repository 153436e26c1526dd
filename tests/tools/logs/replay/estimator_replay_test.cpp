#include "tools/logs/replay/estimator_replay.h"

#include <gtest/gtest.h>

#include "lcmtypes/channels.h"
#include "robots/robot_loader.h"
#include "signals/drive_command.h"
#include "signals/drive_state.h"
#include "signals/sensors.h"
#include "tests/tools/logs/replay/logged_message.h"

namespace sprung {
namespace {

using test::message_of;

class EstimatorReplayTest : public testing::Test {
 protected:
  /// With a joint state that no estimator makes.
  LoggedCycle cycle(std::int64_t seq, std::int64_t used_imu_seq = -1) const {
    DriveState drives(robot_.actuators.size());
    JointState joints(robot_.joints.size(), robot_.legs.size());
    drives.stamp = joints.stamp = {2000 * seq, seq};
    joints.joints[0].estimated_position_rad = kLogged_rad;
    joints.used_imu_seq = used_imu_seq;
    LoggedCycle out;
    out.seq = seq;
    out.drive_state = message_of(drives);
    out.joint_state = message_of(joints);
    return out;
  }
  double position_rad() const { return out_.joint_state.joints[0].estimated_position_rad; }

  static constexpr double kLogged_rad = 12.25;
  const RobotConfig robot_ = load_robot("pegasus");
  EstimatorReplay estimates_{robot_, "best", robot_.watchdogs, true};
  EstimatorReplay takes_{robot_, "best", robot_.watchdogs, false};
  EstimatedCycle out_{robot_};
};

TEST_F(EstimatorReplayTest, JointStateIsMadeFromTheDrives) {
  estimates_.step(cycle(5), out_);
  EXPECT_TRUE(out_.known);
  EXPECT_TRUE(out_.made);
  EXPECT_FALSE(out_.missing);
  EXPECT_EQ(out_.joint_state.stamp.seq, 5);
  EXPECT_NE(position_rad(), kLogged_rad);
}

TEST_F(EstimatorReplayTest, JointStateIsTheLogsWhereTheEstimatorDoesNotRun) {
  takes_.step(cycle(5), out_);
  EXPECT_TRUE(out_.known);
  EXPECT_FALSE(out_.made);
  EXPECT_EQ(position_rad(), kLogged_rad);
  EXPECT_EQ(out_.joint_state.joints.size(), robot_.joints.size());
}

TEST_F(EstimatorReplayTest, CycleInWhichNoCoreMadeAnythingIsNotEstimated) {
  LoggedCycle unanswered = cycle(5);
  unanswered.joint_state.clear();
  estimates_.step(unanswered, out_);
  EXPECT_FALSE(out_.known);
  EXPECT_FALSE(out_.missing);
}

TEST_F(EstimatorReplayTest, DriveStateThatTheLogLacksIsMissingOnceOneWasThere) {
  LoggedCycle gap = cycle(5);
  gap.drive_state.clear();
  estimates_.step(gap, out_);
  EXPECT_FALSE(out_.known);
  EXPECT_FALSE(out_.missing) << "the log begins in the middle";
  estimates_.step(cycle(6), out_);
  gap.seq = 7;
  estimates_.step(gap, out_);
  ASSERT_TRUE(out_.missing);
  EXPECT_STREQ(out_.missing->core, "estimator");
  EXPECT_STREQ(out_.missing->channel, channels::kDriveState);
  EXPECT_EQ(out_.missing->seq, 7);
  EXPECT_TRUE(out_.known);
  EXPECT_FALSE(out_.made);
  EXPECT_EQ(position_rad(), kLogged_rad);
  estimates_.step(cycle(8), out_);
  EXPECT_FALSE(out_.missing) << "of the cycle before";
}

TEST_F(EstimatorReplayTest, JointStateThatTheLogLacksIsMissingToTheOthers) {
  takes_.step(cycle(5), out_);
  LoggedCycle gap = cycle(6);
  gap.joint_state.clear();
  gap.drive_command = message_of(DriveCommand(robot_.actuators.size()));
  takes_.step(gap, out_);
  EXPECT_FALSE(out_.known);
  ASSERT_TRUE(out_.missing);
  EXPECT_STREQ(out_.missing->core, "planner and controller");
  EXPECT_EQ(out_.missing->seq, 6);
}

TEST_F(EstimatorReplayTest, SampleOfTheImuThatWasUsedAndIsNotInTheLogIsMissing) {
  estimates_.step(cycle(5, 3), out_);
  ASSERT_TRUE(out_.missing);
  EXPECT_STREQ(out_.missing->channel, channels::kImu);
  EXPECT_EQ(out_.missing->seq, 3);
  EXPECT_TRUE(out_.made);
}

TEST_F(EstimatorReplayTest, SamplesOfAnotherSessionAreForgotten) {
  LoggedCycle first = cycle(3, 3), anew = cycle(4, 3);
  Imu imu;
  imu.stamp = {6000, 3};
  first.imu = message_of(imu);
  estimates_.step(first, out_);
  EXPECT_FALSE(out_.missing);
  anew.anew = true;
  estimates_.step(anew, out_);
  EXPECT_TRUE(out_.missing);
}

TEST_F(EstimatorReplayTest, MessageOfAnotherRobotIsRefusedInWords) {
  LoggedCycle foreign = cycle(5);
  foreign.drive_state = message_of(DriveState(2));
  try {
    estimates_.step(foreign, out_);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("DRIVE_STATE is of another robot"), std::string::npos);
  }
}

}  // namespace
}  // namespace sprung
