/// The real sprung-torque-estimator, started as a child and fed with DRIVE_STATEs over LCM.
#include <gtest/gtest.h>

#include <csignal>
#include <memory>
#include <string>
#include <vector>

#include "lcmtypes/channels.h"
#include "runtime/node.h"
#include "runtime/process_status.h"
#include "signals/drive_state.h"
#include "signals/joint_state.h"
#include "tests/runtime/child.h"
#include "tests/runtime/lcm_network.h"
#include "tests/support/paths.h"

namespace sprung {
namespace {

using test::Child;

constexpr std::int64_t kSession = 4711;
constexpr std::int64_t kLong_us = 20'000'000;

class EstimatorProcessTest : public ::testing::Test {
 protected:
  EstimatorProcessTest() : node_({url_, kSession, 0, {}}) {
    node_.subscribe(channels::kJointState, CountLimits::exactly(2, 1), joint_states_);
    node_.subscribe_message(channels::kProcessStatus, CountLimits::none(), statuses_);
    receiving_ = std::make_unique<Receiving>(node_);
  }

  std::vector<std::string> command(const std::string& clock, std::vector<std::string> more = {}) const {
    std::vector<std::string> words{test::bin_dir() + "/sprung-torque-estimator",
                                   "--robot",
                                   test::source_dir() + "/robots/single_leg",
                                   "--session",
                                   std::to_string(kSession),
                                   "--lcm-url",
                                   url_,
                                   "--no-key",
                                   "--simulation",
                                   "--clock",
                                   clock};
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  /// Waits for a status of that state; remembers the last one.
  bool reaches(ProcessState state) {
    return eventually([&] {
      while (auto one = statuses_.pop()) status_ = *one;
      return status_.process == "sprung-torque-estimator" && status_.state == static_cast<std::int8_t>(state);
    });
  }

  template <class Condition>
  bool eventually(Condition condition) {
    const std::int64_t end_us = node_.utime_us() + kLong_us;
    while (!condition()) {
      if (node_.utime_us() > end_us) return false;
      node_.wait_for_input(node_.utime_us() + 10'000);
    }
    return true;
  }

  bool answered(std::int64_t seq, JointState& out) {
    return eventually([&] { return joint_states_.get(seq, out); });
  }

  static DriveState drive_state(std::int64_t seq) {
    DriveState state(2);
    state.stamp = {1000 * seq, seq};
    for (ActuatorState& actuator : state.actuators) {
      actuator.measured_position_rad = 1.0 + 1e-3 * static_cast<double>(seq);
      actuator.measured_current_A = 0.5;
      actuator.power_state = PowerState::kOperationEnabled;
      actuator.shown_mode = DriveMode::kTorque;
      actuator.referenced = true;
    }
    state.safety = SafetyLevel::kOperational;
    return state;
  }

  const std::string url_ = test::own_lcm_url();
  Slot<JointState> joint_states_{JointState(2, 1)};
  InputQueue<sprung_msgs::process_status_t> statuses_{1000};
  Node node_;
  std::unique_ptr<Receiving> receiving_;
  Publisher<DriveState> drive_states_ = node_.publisher<DriveState>(channels::kDriveState);
  sprung_msgs::process_status_t status_{};
  JointState out_;
};

TEST_F(EstimatorProcessTest, AnswersEachCycleAndStopsOnRequest) {
  Child child(command("lockstep"));
  ASSERT_TRUE(reaches(ProcessState::kReady));
  EXPECT_EQ(status_.robot, "single_leg");
  EXPECT_EQ(status_.clock, "lockstep");
  EXPECT_EQ(status_.session, kSession);
  for (std::int64_t seq = 0; seq < 200; ++seq) {
    drive_states_.publish(drive_state(seq));
    ASSERT_TRUE(answered(seq, out_)) << seq;
    EXPECT_EQ(out_.stamp.utime_us, 1000 * seq);
    EXPECT_EQ(out_.used_drive_state_seq, seq);
  }
  EXPECT_NEAR(out_.joints[0].estimated_position_rad, 1.199, 5e-3);
  ASSERT_TRUE(reaches(ProcessState::kRunning));
  child.signal(SIGTERM);
  ASSERT_TRUE(reaches(ProcessState::kStopping));
  EXPECT_EQ(status_.cycles, 200);
  EXPECT_EQ(status_.sequence_gaps, 0);
  EXPECT_EQ(child.wait(), 0);
}

TEST_F(EstimatorProcessTest, RepeatIsAnsweredFromStoreWithoutStepping) {
  Child child(command("lockstep"));
  ASSERT_TRUE(reaches(ProcessState::kReady));
  for (std::int64_t seq = 0; seq < 10; ++seq) {
    drive_states_.publish(drive_state(seq));
    ASSERT_TRUE(answered(seq, out_));
  }
  DriveState changed = drive_state(9);
  changed.actuators[0].measured_position_rad = 2.0;  // must not be looked at
  drive_states_.publish(changed);
  std::optional<std::int64_t> repeated;
  ASSERT_TRUE(eventually([&] { return (repeated = joint_states_.take_repeated()) == 9; }));
  child.signal(SIGINT);
  ASSERT_TRUE(reaches(ProcessState::kStopping));
  EXPECT_EQ(status_.cycles, 10);
  EXPECT_EQ(child.wait(), 0);
}

TEST_F(EstimatorProcessTest, LostAnswerIsRepairedByARepeatedInput) {
  Child child(
      command("lockstep", {"--inject", "drop-tx:JOINT_STATE:5", "--inject", "drop-rx:DRIVE_STATE:7"}));
  ASSERT_TRUE(reaches(ProcessState::kReady));
  for (std::int64_t seq = 0; seq < 10; ++seq) {
    const DriveState state = drive_state(seq);
    drive_states_.publish(state);
    if (seq == 5 || seq == 7) {
      node_.wait_for_input(node_.utime_us() + 50'000);
      EXPECT_FALSE(joint_states_.get(seq, out_));
      // As whoever drives the lock-step does: again until there is an answer. A process that is late may take
      // the input and its repetition at once, and lose the one answer.
      ASSERT_TRUE(eventually([&] {
        drive_states_.publish(state);
        node_.wait_for_input(node_.utime_us() + 50'000);
        return joint_states_.get(seq, out_);
      })) << seq;
    }
    ASSERT_TRUE(answered(seq, out_)) << seq;
  }
  child.signal(SIGTERM);
  ASSERT_TRUE(reaches(ProcessState::kStopping));
  EXPECT_EQ(status_.cycles, 10);
  EXPECT_EQ(child.wait(), 0);
}

TEST_F(EstimatorProcessTest, RealTimeAnswersTheNewest) {
  Child child(command("realtime", {"--rt-policy", "off"}));
  ASSERT_TRUE(reaches(ProcessState::kReady));
  for (const std::int64_t seq : {0, 1, 7}) {
    drive_states_.publish(drive_state(seq));
    ASSERT_TRUE(answered(seq, out_));
  }
  child.signal(SIGTERM);
  ASSERT_TRUE(reaches(ProcessState::kStopping));
  EXPECT_EQ(status_.sequence_gaps, 5);
  EXPECT_EQ(child.wait(), 0);
}

TEST_F(EstimatorProcessTest, RefusesMessagesOfAnotherSession) {
  Child child(command("lockstep"));
  ASSERT_TRUE(reaches(ProcessState::kReady));
  Node stranger({url_, kSession + 1, 0, {}});
  stranger.publisher<DriveState>(channels::kDriveState).publish(drive_state(0));
  ASSERT_TRUE(eventually([&] {
    while (auto one = statuses_.pop()) status_ = *one;
    return status_.refused_messages == 1;
  }));
  EXPECT_EQ(status_.detail, "DRIVE_STATE refused: wrong session, found 4712, expected 4711");
  EXPECT_EQ(joint_states_.held().count, 0);
}

TEST_F(EstimatorProcessTest, WrongUseEndsWithTwoAndAMissingRobotWithOne) {
  Child no_session({test::bin_dir() + "/sprung-torque-estimator"});
  EXPECT_EQ(WEXITSTATUS(no_session.wait()), 2);
  Child no_preset(command("lockstep", {"--preset", "nope"}));
  EXPECT_EQ(WEXITSTATUS(no_preset.wait()), 2);
  Child no_robot({test::bin_dir() + "/sprung-torque-estimator", "--session", "1", "--robot", "/nowhere"});
  EXPECT_EQ(WEXITSTATUS(no_robot.wait()), 1);
}

}  // namespace
}  // namespace sprung
