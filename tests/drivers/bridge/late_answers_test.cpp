// A node that stalls and then answers several SYNCs at once, as a simulation that was not scheduled: which
// answer is the sample, when it was taken, and what still counts as a jump.
#include <gmock/gmock.h>

#include "tests/drivers/bridge/faults_fixture.h"

namespace sprung {
namespace {

constexpr int kStall_cycles = 20;
constexpr double kCounts_per_rad = 131072.0 * 100.0 / 6.283185307179586;
// 4 rad/s: in a cycle far below what the bridge takes for a jump (36 rad/s), in twenty cycles far above.
constexpr std::int32_t kCounts_per_cycle = 8344;

class LateAnswers : public BridgeFaults {
 protected:
  void SetUp() override { begin(30); }
  /// @param silent_cycles as in simulation_watchdogs, or the robot's.
  void begin(int silent_cycles) {
    RobotConfig robot = test::two_drive_robot();
    robot.watchdogs.silent_cycles = silent_cycles;
    bench_ = test::BridgeBench(robot);
    ASSERT_TRUE(bench_.boot());
    bench_.enable();
    ASSERT_EQ(enabled(), 2);
  }
  /// One cycle of steady motion in which the hip's answer is kept, and the first `paid` of all that are kept
  /// are sent.
  void move(std::size_t paid) {
    bend_samples([this, paid](std::vector<CanFrame>& frames, std::size_t i) {
      if (bent_) return;
      bent_ = true;
      held_.push_back(frames[i]);
      const auto end = held_.begin() + static_cast<std::ptrdiff_t>(std::min(paid, held_.size()));
      frames.erase(frames.begin() + static_cast<std::ptrdiff_t>(i));
      frames.insert(frames.begin() + static_cast<std::ptrdiff_t>(i), held_.begin(), end);
      held_.erase(held_.begin(), end);
    });
    bent_ = false;
    bench_.drives[0].position_counts += kCounts_per_cycle;
    bench_.tick();
    bench_.on_answers = nullptr;
  }
  void run(int cycles, std::size_t paid) {
    for (int i = 0; i < cycles; ++i) move(paid);
  }
  /// The first `count` of those that are kept, when the cycle is over.
  void pay_after_the_cycle(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) bench_.bridge->receive(0, held_[i], bench_.time_us + 900);
    held_.erase(held_.begin(), held_.begin() + static_cast<std::ptrdiff_t>(count));
  }
  double true_position_rad() { return 0.1 + bench_.drives[0].position_counts / kCounts_per_rad; }
  double position_rad() { return bench_.state.actuators[0].measured_position_rad; }
  void expect_well() { EXPECT_EQ(level(), SafetyLevel::kOperational) << bench_.detail(); }

  std::vector<CanFrame> held_;
  bool bent_ = false;
};

TEST_F(LateAnswers, OfSeveralAtOnceTheNewestIsTheSample) {
  run(10, 1);
  run(kStall_cycles, 0);
  move(kStall_cycles + 1);
  EXPECT_NEAR(position_rad(), true_position_rad(), 1e-5);
  EXPECT_EQ(bench_.state.actuators[0].age_cycles, 0);
  EXPECT_EQ(health(0).late_samples, kStall_cycles);
  EXPECT_EQ(health(0).duplicate_samples, 0);
  run(20, 1);
  expect_well();
}

TEST_F(LateAnswers, ThatComeOverSeveralCyclesAreNoJump) {
  run(10, 1);
  run(kStall_cycles, 0);
  while (!held_.empty()) {
    move(7);
    expect_well();
  }
  EXPECT_NEAR(position_rad(), true_position_rad(), 1e-5);
  run(20, 1);
  expect_well();
}

TEST_F(LateAnswers, OldOneWhoseFollowersAreLostIsNoJump) {
  run(10, 1);
  run(kStall_cycles, 0);
  move(1);
  EXPECT_NEAR(position_rad(), true_position_rad() - kStall_cycles * kCounts_per_cycle / kCounts_per_rad,
              1e-5);
  held_.clear();
  for (int i = 0; i < 20; ++i) {
    move(1);
    expect_well();
    EXPECT_NEAR(position_rad(), true_position_rad(), 1e-5);
  }
}

TEST_F(LateAnswers, ThatComeAfterTheirCycleAreNotMistakenForTheNext) {
  run(10, 1);
  run(kStall_cycles, 0);
  move(1);  // of twenty cycles ago; the others when the cycle is over
  pay_after_the_cycle(held_.size());
  move(1);
  expect_well();
  EXPECT_NEAR(position_rad(), true_position_rad(), 1e-5);
}

TEST_F(LateAnswers, ThatComeAfterTheirCycleShowThatTheNodeLives) {
  run(10, 1);
  run(kStall_cycles, 0);
  pay_after_the_cycle(kStall_cycles);
  const double position_then_rad = true_position_rad();
  run(kStall_cycles, 0);
  EXPECT_NEAR(position_rad(), position_then_rad, 1e-5);
  EXPECT_EQ(bench_.state.actuators[0].age_cycles, kStall_cycles);
  EXPECT_EQ(health(0).missing_samples, 2 * kStall_cycles);
  expect_well();
  move(kStall_cycles + 1);
  EXPECT_NEAR(position_rad(), true_position_rad(), 1e-5);
  run(20, 1);
  expect_well();
}

TEST_F(LateAnswers, OldOnesDoNotMakeTheSampleYoungerThanItIs) {
  run(10, 1);
  run(kStall_cycles, 0);
  pay_after_the_cycle(5);
  move(0);
  EXPECT_EQ(bench_.state.actuators[0].age_cycles, kStall_cycles + 1 - 5);
  run(30 - (kStall_cycles + 1 - 5), 0);
  expect_well();
  move(0);
  EXPECT_EQ(cause(), SafetyCause::kDriveSilent);
  EXPECT_THAT(bench_.detail(), ::testing::HasSubstr("hip_motor: did not answer SYNC for 31 cycles"));
}

TEST_F(LateAnswers, JumpThatComesAfterTheCycleIsCaught) {
  run(10, 1);
  move(0);
  bench_.drives[0].position_counts += 131072 * 20;
  move(0);
  pay_after_the_cycle(2);
  move(0);
  expect_damping(SafetyCause::kImplausible, "hip_motor: measured position jumped");
}

TEST_F(LateAnswers, JumpThatComesWithThemIsCaught) {
  run(10, 1);
  run(kStall_cycles, 0);
  bench_.drives[0].position_counts += 131072 * 20;
  move(kStall_cycles + 1);
  expect_damping(SafetyCause::kImplausible, "hip_motor: measured position jumped");
}

TEST_F(LateAnswers, OnceTheyAreAllInABoundOfOneCycleHolds) {
  run(10, 1);
  run(kStall_cycles, 0);
  move(kStall_cycles + 1);
  bench_.drives[0].position_counts += static_cast<std::int32_t>(0.04 * kCounts_per_rad);
  move(1);
  expect_damping(SafetyCause::kImplausible, "hip_motor: measured position jumped");
}

/// Nobody knows whether an answer that is missing was lost or comes later. After ten cycles in time it was
/// lost.
TEST_F(LateAnswers, ThatNeverComeLoosenTheBoundOnlyForAWhile) {
  run(10, 1);
  run(kStall_cycles, 0);
  held_.clear();
  run(11, 1);
  expect_well();
  bench_.drives[0].position_counts += static_cast<std::int32_t>(0.04 * kCounts_per_rad);
  move(1);
  expect_damping(SafetyCause::kImplausible, "hip_motor: measured position jumped");
}

/// On a robot no answer counts as older than the silence that robot.yaml's watchdogs allow, however many were
/// lost.
TEST_F(LateAnswers, ThatAreLostOftenLoosenTheBoundByTheSilenceAllowedAtMost) {
  begin(2);
  for (int i = 0; i < 30; ++i) {
    move(0);
    held_.clear();
    run(3, 1);
  }
  expect_well();
  EXPECT_EQ(health(0).missing_samples, 30);
  bench_.drives[0].position_counts += static_cast<std::int32_t>(3.2 * 0.036 * kCounts_per_rad);
  move(1);
  expect_damping(SafetyCause::kImplausible, "hip_motor: measured position jumped");
}

TEST_F(LateAnswers, MakeNoVelocityThatDampingWouldFightAgainst) {
  run(200, 1);
  run(kStall_cycles, 0);
  move(kStall_cycles + 1);
  bench_.mute_commands = true;
  run(25, 1);
  ASSERT_EQ(level(), SafetyLevel::kDamping);
  EXPECT_NEAR(bench_.drives[0].target_torque_permille, -1000.0 * 4.0 * 12.0 / 30.8, 20.0);
}

/// A second device beside a drive that has just lost an answer: nobody can tell which is which, so what comes
/// last must follow from where the drive was.
TEST_F(LateAnswers, OfASecondDeviceThatIsElsewhereAreAJump) {
  begin(2);
  move(0);
  held_.clear();
  bend_samples([](std::vector<CanFrame>& frames, std::size_t i) {
    if (i > 0 && frames[i - 1].id == kHipSample) return;
    CanFrame other = frames[i];
    other.data[3] ^= 0x10;
    frames.insert(frames.begin() + static_cast<std::ptrdiff_t>(i) + 1, other);
  });
  bench_.tick();
  EXPECT_EQ(cause(), SafetyCause::kImplausible) << bench_.detail();
}

class CaughtUp : public LateAnswers {
 protected:
  /// A cycle in which the hip's frames come in one by one, the knee's before. @return after how many the
  /// bridge would go on.
  std::size_t frames_waited_for(const std::vector<CanFrame>& hip) {
    FrameBatch begun;
    bench_.time_us += 1000;
    bench_.bridge->begin_tick(bench_.time_us, begun);
    std::vector<CanFrame> knee;
    bench_.drives[1].receive(canopen::sync_frame(), knee);
    for (const CanFrame& frame : knee) bench_.bridge->receive(0, frame, bench_.time_us);
    std::size_t count = 0;
    while (count < hip.size() && !bench_.bridge->all_answered())
      bench_.bridge->receive(0, hip[count++], bench_.time_us);
    EXPECT_EQ(bench_.bridge->all_answered(), count > 0);
    bench_.bridge->end_sampling(bench_.time_us, bench_.state);
    return count;
  }
  CanFrame hip_answer() {
    bench_.drives[0].position_counts += kCounts_per_cycle;
    std::vector<CanFrame> frames;
    bench_.drives[0].receive(canopen::sync_frame(), frames);
    return frames.front();
  }
};

TEST_F(CaughtUp, NodeThatWasSilentIsWaitedForUntilItHasPaidAll) {
  run(3, 0);
  held_.push_back(hip_answer());
  EXPECT_EQ(frames_waited_for(held_), 4U);
  EXPECT_EQ(frames_waited_for({hip_answer()}), 1U);
}

}  // namespace
}  // namespace sprung
