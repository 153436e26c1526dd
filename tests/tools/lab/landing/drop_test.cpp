#include "tools/lab/landing/drop.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

using testing::HasSubstr;

TEST(DrawnSurprise, IsSpreadEvenlyWithinItsBoundsAndTheSameForTheSameSeed) {
  constexpr int kSeeds = 400;
  std::set<double> different;
  double sum_s = 0.0, least_s = 1.0, most_s = -1.0;
  for (int seed = 0; seed < kSeeds; ++seed) {
    const double surprise_s = drawn_surprise_s(seed, 0.01);
    different.insert(surprise_s);
    sum_s += surprise_s;
    least_s = std::min(least_s, surprise_s);
    most_s = std::max(most_s, surprise_s);
    EXPECT_EQ(drawn_surprise_s(seed, 0.01), surprise_s);
    EXPECT_DOUBLE_EQ(drawn_surprise_s(seed, 0.02), 2.0 * surprise_s);
  }
  EXPECT_EQ(different.size(), kSeeds);
  EXPECT_NEAR(sum_s / kSeeds, 0.0, 0.001);
  EXPECT_GE(least_s, -0.01);
  EXPECT_LT(least_s, -0.0095);
  EXPECT_LE(most_s, 0.01);
  EXPECT_GT(most_s, 0.0095);
}

class DropScript : public testing::Test {
 protected:
  double floor_m(double surprise_s, double height_m = 0.3) const {
    for (const SimControl& control :
         drop_script(robot_, "best", {}, {JumpMode::kAdaptive, height_m, surprise_s}).controls)
      if (control.kind == SimControlKind::kFloor) return control.value;
    ADD_FAILURE() << "no floor";
    return kNaN;
  }
  RobotConfig robot_ = load_robot("single_leg");
};

TEST_F(DropScript, LetsGoAndSaysLandInOneCycleInTheModeThatWasAsked) {
  SimOptions sim;
  sim.seed = 9;
  const RunScript script = drop_script(robot_, "best", sim, {JumpMode::kAdaptive, 0.3, 0.0});
  const std::int64_t release = release_cycle(robot_, "best");
  const OperatorCommand& land = script.commands.back();
  EXPECT_EQ(script.commands.front().kind, OperatorKind::kStand);
  EXPECT_EQ(land.kind, OperatorKind::kLand);
  EXPECT_EQ(land.jump_mode, JumpMode::kAdaptive);
  EXPECT_EQ(land.apply_at_seq, release);
  EXPECT_EQ(script.controls.back().kind, SimControlKind::kSuspend);
  EXPECT_EQ(script.controls.back().apply_at_seq, release);
  EXPECT_EQ(script.sim.seed, 9u);
  EXPECT_DOUBLE_EQ(script.sim.plant.at("suspended"), robot_.preset("best").stand_length_m + 0.02 + 0.3);
  EXPECT_GT(script.cycles, release + 1000);
}

TEST_F(DropScript, TouchdownIsExpectedWhenALegOfLandingLengthWouldTouch) {
  const PresetConfig& preset = robot_.preset("best");
  const RunScript script = drop_script(robot_, "best", {}, {JumpMode::kAdaptive, 0.3, 0.0});
  const double fall_s = script.commands.back().touchdown_in_s;
  EXPECT_NEAR(0.5 * 9.81 * fall_s * fall_s, 0.3 + preset.stand_length_m - preset.landing_length_m, 1e-12);
}

TEST_F(DropScript, SurpriseMovesTheFloorAndNothingThatTheRobotIsTold) {
  EXPECT_DOUBLE_EQ(floor_m(0.0), 0.0);
  const RunScript plain = drop_script(robot_, "best", {}, {JumpMode::kAdaptive, 0.3, 0.0});
  const RunScript late = drop_script(robot_, "best", {}, {JumpMode::kAdaptive, 0.3, 0.01});
  const double fall_s = plain.commands.back().touchdown_in_s;
  EXPECT_EQ(late.commands.back().touchdown_in_s, fall_s);
  const double deeper_m = 0.5 * 9.81 * (std::pow(fall_s + 0.01, 2) - fall_s * fall_s);
  EXPECT_NEAR(floor_m(0.01), -deeper_m, 1e-12);
  EXPECT_GT(floor_m(-0.01), 0.0);
}

/// Plays a made-up landing through the metrics: the foot comes down with 2 m/s and touches in cycle 100 after
/// the release.
class DropMetricsTest : public testing::Test {
 protected:
  static constexpr std::int64_t kRelease = 50;

  void cycle(MotionPhase phase, double foot_m, double force_N = 0.0) {
    motion_.state = phase;
    truth_.stamp.seq = ++seq_;
    truth_.base_in_world_m[2] = foot_m + length_m_;
    truth_.legs[0].true_foot_in_world_m[2] = foot_m;
    truth_.legs[0].true_contact_force_N[2] = force_N;
    for (int joint = 0; joint < 2; ++joint) {
      joints_.joints[joint].motor_side_torque_Nm = motor_Nm_[joint];
      truth_.joints[joint].true_gear_output_torque_Nm = output_Nm_[joint];
    }
    truth_.joints[1].true_position_rad = knee_rad_;
    metrics_.add({drives_, joints_, motion_, commands_, truth_, legs_});
  }
  void fall() {
    while (seq_ < kRelease + 99)
      cycle(MotionPhase::kFlight, 0.002 * static_cast<double>(kRelease + 100 - seq_ - 1));
  }
  void land(int cycles = 100) {
    for (int i = 0; i < cycles; ++i) cycle(MotionPhase::kLanding, 0.0, 50.0);
  }
  void stand() {
    cycle(MotionPhase::kRecover, 0.0, 50.0);
    cycle(MotionPhase::kStanding, 0.0, 50.0);
  }

  RobotConfig robot_ = load_robot("single_leg");
  DropMetrics metrics_{robot_, kRelease};
  std::int64_t seq_ = -1;
  double length_m_ = 0.6, knee_rad_ = 1.5;
  std::array<double, 2> motor_Nm_{1.0, -2.0}, output_Nm_{3.0, -4.0};
  DriveState drives_{2};
  JointState joints_{2, 1};
  MotionState motion_{1};
  DriveCommand commands_{2};
  SimTruth truth_{2, 1};
  LegCommand legs_{1};
};

TEST_F(DropMetricsTest, TouchdownIsTheFirstTrueForceAfterTheRelease) {
  cycle(MotionPhase::kStanding, 0.2, 40.0);  // before the release: the hand that holds it
  fall();
  land();
  stand();
  const DropResult r = metrics_.result();
  EXPECT_NEAR(r.touchdown_s, 0.1, 1e-12);
  EXPECT_NEAR(r.touchdown_speed_m_s, 2.0, 1e-9);
  EXPECT_NEAR(r.touchdown_length_m, 0.6, 1e-12);
  EXPECT_FALSE(r.folded);
}

TEST_F(DropMetricsTest, PeaksAreTheWorstJointsFromTouchdownUntilItStandsUp) {
  motor_Nm_ = {500.0, 500.0};
  output_Nm_ = {500.0, 500.0};
  fall();
  motor_Nm_ = {11.0, -12.0};
  output_Nm_ = {-21.0, 22.0};
  land();
  motor_Nm_ = {500.0, 500.0};
  output_Nm_ = {500.0, 500.0};
  stand();
  const DropResult r = metrics_.result();
  EXPECT_EQ(r.peak_motor_torque_Nm, 12.0);
  EXPECT_EQ(r.peak_output_torque_Nm, 22.0);
  EXPECT_EQ(r.peak_hip_output_torque_Nm, 21.0);
}

TEST_F(DropMetricsTest, ShortestLegIsFollowedAfterTouchdown) {
  length_m_ = 0.2;
  fall();
  length_m_ = 0.5;
  land(50);
  length_m_ = 0.3;
  land(1);
  length_m_ = 0.4;
  stand();
  EXPECT_NEAR(metrics_.result().shortest_m, 0.3, 1e-12);
}

TEST_F(DropMetricsTest, KneeAtItsStopIsFoldedEvenWhereItStandsLater) {
  fall();
  land(10);
  knee_rad_ = robot_.joints[1].position_max_rad - 0.02;
  land(1);
  knee_rad_ = 1.5;
  land(10);
  EXPECT_TRUE(metrics_.result().folded);
  stand();
  EXPECT_TRUE(metrics_.result().folded);
}

TEST_F(DropMetricsTest, LegThatNeverStandsAgainOrNeverTouchesIsFolded) {
  fall();
  EXPECT_TRUE(metrics_.result().folded);
  EXPECT_TRUE(std::isnan(metrics_.result().peak_output_torque_Nm));
  land();
  EXPECT_TRUE(metrics_.result().folded);
  cycle(MotionPhase::kIdle, 0.0, 50.0);  // given up
  EXPECT_TRUE(metrics_.result().folded);
}

TEST(DropMetrics, RobotWithoutAKneeIsRefused) {
  EXPECT_THROW(DropMetrics(load_robot("test_axis"), 0), std::invalid_argument);
}

TEST(RunDrop, SimulatedLegFallsFreelyLandsAndStandsAndTheWatcherSeesEveryCycle) {
  const RobotConfig robot = load_robot("single_leg");
  const RunScript script = drop_script(robot, "paper", {}, {JumpMode::kHybrid, 0.2, 0.0});
  std::int64_t watched = 0;
  const DropResult r = run_drop(script, run_in_process, [&](const CycleRecord&) { ++watched; });
  EXPECT_EQ(watched, script.cycles);
  EXPECT_FALSE(r.folded);
  EXPECT_NEAR(r.touchdown_s, script.commands.back().touchdown_in_s, 0.01);
  EXPECT_NEAR(r.touchdown_speed_m_s, 9.81 * r.touchdown_s, 0.4);
  EXPECT_LT(r.shortest_m, r.touchdown_length_m);
  EXPECT_GT(r.peak_output_torque_Nm, r.peak_motor_torque_Nm);  // the ground turns the rotors
}

TEST(RunDrop, RefusedCommandEndsItWithTheReason) {
  const auto refuse = [](const RunScript&, const CycleObserver&, const ReplyObserver& on_reply) {
    OperatorReply reply;
    reply.outcome = OperatorOutcome::kRefused;
    reply.reason = "not standing";
    on_reply(reply);
  };
  const RunScript script = drop_script(load_robot("single_leg"), "best", {}, {});
  try {
    run_drop(script, refuse);
    FAIL() << "went on";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("not standing"));
  }
}

}  // namespace
}  // namespace sprung
