#include "tools/logs/replay/core_replay.h"

#include <gtest/gtest.h>

#include "lcmtypes/channels.h"
#include "robots/robot_loader.h"
#include "runtime/message_layout.h"
#include "signals/drive_state.h"
#include "signals/sensors.h"
#include "tests/support/enumerators.h"
#include "tests/tools/logs/replay/logged_message.h"

namespace sprung {
namespace {

using test::message_of;

/// The estimator of a robot with a trunk, on cycles that are made here.
class CoreReplayTest : public testing::Test {
 protected:
  CoreReplayTest() {
    replay_.on_difference([this](const MessagePair& pair) { differing_.emplace_back(pair.channel); });
  }
  LoggedCycle cycle(std::int64_t seq) const {
    DriveState state(robot_.actuators.size());
    Imu imu;
    state.stamp = imu.stamp = {2000 * seq, seq};
    LoggedCycle out;
    out.seq = seq;
    out.time_s = 0.002 * static_cast<double>(seq);
    out.drive_state = message_of(state);
    out.imu = message_of(imu);
    return out;
  }

  void step(const LoggedCycle& cycle) {
    estimator_.step(cycle, estimated_);
    replay_.step(cycle, estimated_);
  }

  const RobotConfig robot_ = load_robot("pegasus");
  EstimatorReplay estimator_{robot_, "best", robot_.watchdogs, true};
  EstimatedCycle estimated_{robot_};
  CoreReplay replay_{robot_, "best", robot_.watchdogs, core_choice("estimator")};
  std::vector<std::string> differing_;
};

TEST(Cores, EveryOneHasItsOwnName) { test::expect_own_names<Core>(); }

TEST_F(CoreReplayTest, JointStateThatIsCutShortIsADifferenceAndNoMore) {
  LoggedCycle damaged = cycle(0);
  damaged.joint_state = message_of(JointState(robot_.joints.size(), robot_.legs.size()));
  damaged.joint_state.resize(kCountsOffset + 8);
  step(damaged);
  EXPECT_EQ(differing_, std::vector<std::string>{channels::kJointState});
  EXPECT_EQ(replay_.counts().incomplete, 0) << "which sample of the IMU it had, it does not say";
}

TEST_F(CoreReplayTest, JointStateOfAnotherVersionIsCountedByNameAndNotCompared) {
  LoggedCycle old = cycle(0);
  old.joint_state = message_of(JointState(robot_.joints.size(), robot_.legs.size()));
  old.joint_state.resize(old.joint_state.size() - 8 * robot_.joints.size());  // a number less for each joint
  old.joint_state[0] ^= 0x40;
  step(old);
  EXPECT_EQ(replay_.counts().cycles, 1) << "the estimator ran on its DRIVE_STATE";
  EXPECT_EQ(replay_.counts().other_version, 1);
  EXPECT_EQ(replay_.counts().first_other_version, channels::kJointState);
  EXPECT_EQ(replay_.counts().compared, 0);
  EXPECT_TRUE(differing_.empty());
}

TEST_F(CoreReplayTest, CyclesBeforeTheComparedOnesRunAndAreNotCounted) {
  replay_.compare_from(0.004);
  for (std::int64_t k = 0; k < 4; ++k) {
    LoggedCycle one = cycle(k);
    one.joint_state = message_of(JointState(robot_.joints.size(), robot_.legs.size()));  // not what it makes
    step(one);
  }
  EXPECT_EQ(replay_.counts().cycles, 4);
  EXPECT_EQ(replay_.counts().compared, 2);
  EXPECT_EQ(replay_.counts().differing, 2);
  EXPECT_EQ(differing_.size(), 2u);
}

}  // namespace
}  // namespace sprung
