#include "planner/adaptive_landing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

constexpr std::int64_t kCycle_us = 1000;
constexpr double kCycle_s = 1e-3;
constexpr double kDrop_m = 0.3;
constexpr double kReleased_s = 0.247310;  // sqrt(2 * 0.3 m / 9.81 m/s^2)

/// A fall from rest, 0.3 m over the landing length; foot measured where it is desired.
class AdaptiveLandingTest : public testing::Test {
 protected:
  AdaptiveLandingTest() : robot_(load_robot("single_leg")), preset_(robot_.preset("best")) {
    in_.planned.position_m = {0.0, 0.0, -preset_.landing_length_m};
    in_.progress.phase = MotionPhase::kFlight;
    in_.progress.mode = JumpMode::kAdaptive;
    in_.progress.hybrid_switch_s = preset_.hybrid_switch_s;
    in_.measured.foot_force_N = in_.measured.foot_force_bound_N = {0.0, 0.0, 0.0};
  }

  void begin(double fall_s = kReleased_s) {
    law_ = AdaptiveLanding(robot_, robot_.legs[0], preset_);
    law_.begin({std::llround(1e6 * fall_s), kGravity_m_s2 * fall_s});
  }
  const AdaptiveLandingOutput& step() {
    in_.utime_us += kCycle_us;
    in_.progress.since_thrust_s += kCycle_s;
    out_ = law_.step(in_);
    in_.measured.estimated_foot_in_hip_m = out_.desired.position_m;
    return out_;
  }
  void fall(double seconds) {
    for (int k = 0; k < std::lround(seconds / kCycle_s); ++k) step();
  }
  /// The force's second cycle is contact.
  void touch(double force_N = 50.0) {
    in_.measured.foot_force_N[2] = force_N;
    in_.progress.phase = MotionPhase::kLanding;
    step();
    step();
  }
  /// Of the foot over the expected ground, downward: the hip falls freely.
  double approach_m_s() const {
    return kGravity_m_s2 * 1e-6 * static_cast<double>(in_.utime_us) - out_.desired.velocity_m_s[2];
  }
  double foot_over_ground_m() const {
    const double time_s = 1e-6 * static_cast<double>(in_.utime_us);
    return preset_.landing_length_m + kDrop_m - 0.5 * kGravity_m_s2 * time_s * time_s +
           out_.desired.position_m[2];
  }

  RobotConfig robot_;
  PresetConfig preset_;
  AdaptiveLanding law_{robot_, robot_.legs[0], preset_};
  AdaptiveLandingInput in_;
  AdaptiveLandingOutput out_;
};

TEST_F(AdaptiveLandingTest, FootMeetsTheExpectedGroundWithTheApproachSpeed) {
  begin();
  while (in_.utime_us < 400'000) {
    step();
    if (foot_over_ground_m() <= preset_.adaptive_landing.early_m) break;
  }
  EXPECT_NEAR(foot_over_ground_m(), preset_.adaptive_landing.early_m, 0.002);
  const double hip_m_s = kGravity_m_s2 * 1e-6 * static_cast<double>(in_.utime_us);
  const AdaptiveLandingConfig& landing = preset_.adaptive_landing;
  const double slow_m_s = landing.approach_share * kGravity_m_s2 * kReleased_s;
  ASSERT_LT(slow_m_s, landing.approach_m_s);
  EXPECT_NEAR(approach_m_s(), std::max(slow_m_s, hip_m_s - landing.fastest_m_s), 0.05);
  EXPECT_EQ(out_.control_mode, ControlMode::kCompliance);
}

TEST_F(AdaptiveLandingTest, DesiredFootNeitherJumpsNorOutrunsItsSpeedLimit) {
  begin();
  Vec3 before = in_.planned.position_m;
  double longest_m = 0.0;
  for (int k = 0; k < 300; ++k) {
    step();
    EXPECT_LE(std::abs(out_.desired.position_m[2] - before[2]),
              (preset_.adaptive_landing.fastest_m_s + 0.1) * kCycle_s);
    before = out_.desired.position_m;
    longest_m = std::max(longest_m, -before[2]);
  }
  EXPECT_GT(longest_m, preset_.landing_length_m + 0.05);  // it did stretch
  EXPECT_LE(longest_m, preset_.adaptive_landing.extended_length_m + 1e-9);
}

TEST_F(AdaptiveLandingTest, OnTheGroundTheBodyIsStoppedWithinTheWayThatIsLeft) {
  begin();
  fall(0.2);
  touch();
  EXPECT_NEAR(out_.desired.velocity_m_s[2], kGravity_m_s2 * 0.2, 0.05);  // as fast as the body falls
  fall(0.6);
  EXPECT_EQ(out_.gains.stiffness_N_m[2], preset_.adaptive_landing.ground.stiffness_z_N_m);
  EXPECT_EQ(out_.desired.velocity_m_s[2], 0.0);
  EXPECT_NEAR(-out_.desired.position_m[2], preset_.adaptive_landing.shortest_m, 0.01);
  EXPECT_NEAR(out_.feedforward_force_N[2], preset_.adaptive_landing.body_mass_kg * kGravity_m_s2, 1e-9);
}

TEST_F(AdaptiveLandingTest, PushOnABrakingFootIsContactBeforeThePlannerSaysSo) {
  begin();
  fall(0.2);
  in_.measured.foot_force_N = {20.0, 0.0, 0.0};  // along x: the planner looks at z alone
  step();
  EXPECT_EQ(out_.feedforward_force_N[2], 0.0);
  step();
  EXPECT_GT(out_.feedforward_force_N[2], 0.0);
}

TEST_F(AdaptiveLandingTest, ForceWithinItsBoundIsNoContact) {
  begin();
  in_.measured.foot_force_N = {20.0, 0.0, 20.0};
  in_.measured.foot_force_bound_N = {15.0, 0.0, 15.0};
  fall(0.24);
  EXPECT_EQ(out_.feedforward_force_N[2], 0.0);
}

TEST_F(AdaptiveLandingTest, ForceThatRisesFromWhatWasFeltInTheAirIsContactWithinTheBound) {
  begin();
  in_.measured.foot_force_N = {0.0, 0.0, -20.0};  // friction's law is that much off
  in_.measured.foot_force_bound_N = {150.0, 0.0, 150.0};
  fall(0.22);
  in_.measured.foot_force_N[2] = 60.0;
  step();
  EXPECT_EQ(out_.feedforward_force_N[2], 0.0);
  step();
  EXPECT_GT(out_.feedforward_force_N[2], 0.0);
}

TEST_F(AdaptiveLandingTest, WhereNoForceCanTellTheExpectedGroundIsContact) {
  begin();
  in_.measured.foot_force_N = {0.0, 0.0, -300.0};  // another gear's law of friction
  in_.measured.foot_force_bound_N = {130.0, 0.0, 550.0};
  while (foot_over_ground_m() > 0.004) {
    step();
    ASSERT_EQ(out_.feedforward_force_N[2], 0.0) << foot_over_ground_m();
  }
  fall(0.01);
  EXPECT_GT(out_.feedforward_force_N[2], 0.0);
}

TEST_F(AdaptiveLandingTest, ForceThatCannotBeToldFromThePlanDoesNotMoveTheFoot) {
  const auto acceleration_m_s2 = [&](double bound_N) {
    in_ = {};
    in_.planned.position_m = {0.0, 0.0, -preset_.landing_length_m};
    in_.progress.phase = MotionPhase::kFlight;
    in_.progress.mode = JumpMode::kAdaptive;
    begin();
    in_.measured.foot_force_N = in_.measured.foot_force_bound_N = {0.0, 0.0, 0.0};
    fall(0.2);
    touch(250.0);
    const double at_first_m_s2 = out_.desired.acceleration_m_s2[2];
    in_.measured.foot_force_bound_N[2] = bound_N;
    step();
    return out_.desired.acceleration_m_s2[2] - at_first_m_s2;
  };
  EXPECT_NEAR(acceleration_m_s2(0.0), 0.0, 2.0);
  EXPECT_LT(acceleration_m_s2(500.0), -20.0) << "a push of 250 N is hardly believed";
}

TEST_F(AdaptiveLandingTest, ForceThatGrowsWithTheSpeedIsTheLawsErrorAndNoContact) {
  begin();
  in_.measured.foot_force_bound_N = {150.0, 0.0, 150.0};
  step();
  for (int k = 1; foot_over_ground_m() > 0.004; ++k) {
    in_.measured.foot_force_N = {0.0, 0.0, 0.5 * k};  // 110 N at last
    step();
    ASSERT_EQ(out_.feedforward_force_N[2], 0.0) << k;
  }
}

TEST_F(AdaptiveLandingTest, FarAboveTheGroundAForceSomewhatBeyondItsBoundIsATorqueConstantsError) {
  begin();
  in_.measured.foot_force_bound_N = {10.0, 0.0, 45.0};
  in_.measured.foot_force_N = {0.0, 0.0, 65.0};  // seen on a drawn plant, while the rotors speed up
  fall(0.06);
  EXPECT_EQ(out_.feedforward_force_N[2], 0.0);
  in_.measured.foot_force_N[2] = 150.0;
  fall(0.022);
  EXPECT_GT(out_.feedforward_force_N[2], 0.0);
}

TEST_F(AdaptiveLandingTest, FarAboveTheGroundThePlannersContactAndAShortPushAreNotBelieved) {
  begin();
  fall(0.1);
  in_.progress.phase = MotionPhase::kLanding;
  in_.measured.foot_force_N[2] = 50.0;
  fall(0.015);
  in_.measured.foot_force_N[2] = 0.0;
  fall(0.01);
  EXPECT_EQ(out_.feedforward_force_N[2], 0.0);
  in_.measured.foot_force_N[2] = 50.0;  // much too early, but it is the ground
  fall(0.022);
  EXPECT_GT(out_.feedforward_force_N[2], 0.0);
}

TEST_F(AdaptiveLandingTest, StretchOfAShortFallKeepsWithinItsAcceleration) {
  begin(0.12);
  double most_m_s2 = 0.0, longest_m = 0.0;
  for (int k = 0; k < 60; ++k) {  // before it brakes
    step();
    most_m_s2 = std::max(most_m_s2, -out_.desired.acceleration_m_s2[2]);
    longest_m = std::max(longest_m, -out_.desired.position_m[2]);
  }
  EXPECT_LE(most_m_s2, 1.001 * preset_.adaptive_landing.stretch_acceleration_m_s2);
  EXPECT_GT(longest_m, preset_.landing_length_m + 0.005);
}

TEST_F(AdaptiveLandingTest, ForceBeyondThePlanMovesALightFootAndNoMoreOnceTheMassHasFaded) {
  const LandingGains& ground = preset_.adaptive_landing.ground;
  begin();
  fall(0.2);
  touch(100.0);
  AdaptiveLanding same = law_;
  AdaptiveLandingInput pushed = in_;
  in_.utime_us += kCycle_us;
  pushed.utime_us += kCycle_us;
  pushed.measured.foot_force_N[0] += 20.0;
  pushed.measured.foot_force_N[2] += 20.0;
  const AdaptiveLandingOutput as_it_was = law_.step(in_), more = same.step(pushed);
  for (const auto& [axis, mass_kg] : {std::pair{0, ground.mass_x_kg}, std::pair{2, ground.mass_z_kg}})
    EXPECT_NEAR(more.desired.acceleration_m_s2[axis] - as_it_was.desired.acceleration_m_s2[axis],
                20.0 / mass_kg, 0.1 * 20.0 / mass_kg);
  EXPECT_LT(more.gains.damping_N_s_m[2], 0.1 * ground.damping_z_N_s_m);
  in_.measured.foot_force_N = {20.0, 0.0, 120.0};
  fall(preset_.adaptive_landing.mass_s);
  EXPECT_EQ(out_.desired.acceleration_m_s2[0], 0.0);
  EXPECT_EQ(out_.gains.damping_N_s_m[2], ground.damping_z_N_s_m);
}

TEST_F(AdaptiveLandingTest, LostMeasurementLeavesTheDesiredFootFinite) {
  begin();
  fall(0.2);
  in_.measured.foot_force_N[2] = 50.0;
  for (int k = 0; k < 30; ++k) {  // contact is among them
    if (k == 28) in_.measured.foot_force_N = {kNaN, kNaN, kNaN};
    in_.utime_us += kCycle_us;
    in_.measured.estimated_foot_in_hip_m = {kNaN, kNaN, kNaN};
    out_ = law_.step(in_);
    for (const int axis : {0, 2}) {
      ASSERT_TRUE(std::isfinite(out_.desired.position_m[axis])) << k;
      ASSERT_TRUE(std::isfinite(out_.desired.acceleration_m_s2[axis])) << k;
      ASSERT_TRUE(std::isfinite(out_.feedforward_force_N[axis])) << k;
    }
  }
  EXPECT_GT(out_.feedforward_force_N[2], 0.0);
}

TEST_F(AdaptiveLandingTest, PresetWithoutItFallsBackOnTheHybridLaw) {
  preset_.adaptive_landing = {};
  begin();
  in_.progress.since_thrust_s = preset_.hybrid_switch_s;
  step();
  EXPECT_EQ(out_.control_mode, ControlMode::kCompliance);
  EXPECT_EQ(out_.gains.stiffness_N_m, preset_.hybrid_landing.stiffness_N_m);
  EXPECT_EQ(out_.desired.position_m, in_.planned.position_m);
}

TEST_F(AdaptiveLandingTest, NewFlightKnowsNothingOfTheLast) {
  begin();
  fall(0.2);
  touch();
  fall(0.05);
  in_.utime_us = 0;
  in_.measured.foot_force_N = {0.0, 0.0, 0.0};
  in_.progress = {MotionPhase::kFlight, JumpMode::kAdaptive, 0.0, 0.0, preset_.hybrid_switch_s};
  law_.begin({std::llround(1e6 * kReleased_s), kGravity_m_s2 * kReleased_s});
  AdaptiveLanding fresh(robot_, robot_.legs[0], preset_);
  fresh.begin({std::llround(1e6 * kReleased_s), kGravity_m_s2 * kReleased_s});
  for (int k = 0; k < 150; ++k) {
    in_.utime_us += kCycle_us;
    const AdaptiveLandingOutput used = law_.step(in_), anew = fresh.step(in_);
    ASSERT_EQ(used.desired.position_m, anew.desired.position_m) << k;
    ASSERT_EQ(used.feedforward_force_N, anew.feedforward_force_N) << k;
  }
}

}  // namespace
}  // namespace sprung
