#include "controller/lowering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

constexpr double kSit_m = 0.24;
constexpr double kLowering_s = 1.2;
constexpr std::int64_t kBegan_us = 5'000'000;

class LoweringTest : public testing::Test {
 protected:
  LoweringTest() {
    for (DesiredLeg& leg : last_.legs) {
      leg.control_mode = ControlMode::kCompliance;
      leg.phase = LegPhase::kStance;
    }
    state_.stamp.utime_us = kBegan_us;
    state_.legs[0].estimated_foot_in_hip_m = {0.05, 0.1, -0.45};
    state_.legs[1].estimated_foot_in_hip_m = {-0.03, -0.1, -0.38};  // lifted by 0.07
    last_.legs[1].phase = LegPhase::kSwing;
    last_.legs[1].control_mode = ControlMode::kPosition;
  }
  const DesiredLeg& at(double time_s, std::size_t leg) {
    return lowering_.at(kBegan_us + std::llround(1e6 * time_s)).legs[leg];
  }
  double z_m(double time_s, std::size_t leg) { return at(time_s, leg).desired_foot_in_hip_m[2]; }

  Lowering lowering_{2, kSit_m, kLowering_s};
  LegCommand last_{2};
  JointState state_{6, 2};
};

TEST_F(LoweringTest, BeginsWhereTheFeetAreAndEndsSitting) {
  ASSERT_TRUE(lowering_.begin(last_, state_));
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec3 begin_m = state_.legs[i].estimated_foot_in_hip_m;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(at(0.0, i).desired_foot_in_hip_m[axis], begin_m[axis], 1e-12);
      const double end_m = axis == 2 ? -kSit_m : begin_m[axis];
      EXPECT_NEAR(at(kLowering_s, i).desired_foot_in_hip_m[axis], end_m, 1e-12);
    }
    EXPECT_EQ(at(0.0, i).desired_foot_velocity_m_s, (Vec3{0, 0, 0}));
    EXPECT_EQ(at(kLowering_s, i).control_mode, ControlMode::kPosition);
    EXPECT_EQ(at(kLowering_s, i).feedforward_force_N, (Vec3{0, 0, 0}));
  }
}

TEST_F(LoweringTest, LiftedFootIsPutDownFirst) {
  ASSERT_TRUE(lowering_.begin(last_, state_));
  EXPECT_LT(z_m(0.1, 1), -0.40);
  EXPECT_NEAR(z_m(kPutDown_s, 1), z_m(kPutDown_s, 0), 1e-12);
  EXPECT_NEAR(z_m(0.6, 1), z_m(0.6, 0), 1e-12);
}

TEST_F(LoweringTest, NoStandingLegIsEverStretchedWhateverGroundItStandsOn) {
  last_.legs[1].phase = LegPhase::kStance;  // on a step of 0.07 m
  ASSERT_TRUE(lowering_.begin(last_, state_));
  double before_m[2] = {-0.45, -0.38};
  for (double t = 0.0; t < 1.3; t += 0.01) {
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_GE(z_m(t, i), before_m[i] - 1e-12);
      before_m[i] = z_m(t, i);
    }
  }
  EXPECT_NEAR(before_m[0], -kSit_m, 1e-9);
  EXPECT_NEAR(before_m[1], -kSit_m, 1e-9);
}

TEST_F(LoweringTest, InPositionControlItGoesOnFromWhereTheFootWasDesired) {
  last_.legs[0].control_mode = ControlMode::kPosition;
  last_.legs[0].desired_foot_in_hip_m = {0.05, 0.1, -0.46};  // 0.01 m of load
  ASSERT_TRUE(lowering_.begin(last_, state_));
  EXPECT_EQ(z_m(0.0, 0), -0.46);
  last_.legs[0].desired_foot_in_hip_m[0] = kNaN;
  ASSERT_TRUE(lowering_.begin(last_, state_));
  EXPECT_EQ(z_m(0.0, 0), -0.45);
}

TEST_F(LoweringTest, WithoutAFootThatStandsNothingBegins) {
  last_.legs[0].phase = LegPhase::kSwing;
  EXPECT_FALSE(lowering_.begin(last_, state_));
}

TEST_F(LoweringTest, VelocityBelongsToThePathAndIsThatOfASit) {
  ASSERT_TRUE(lowering_.begin(last_, state_));
  double fastest_m_s = 0.0;
  for (double t = 0.01; t < 1.15; t += 0.01) {
    const double rate = (z_m(t + 1e-3, 0) - z_m(t - 1e-3, 0)) / 2e-3;
    EXPECT_NEAR(at(t, 0).desired_foot_velocity_m_s[2], rate, 1e-4);
    const double lifted = (z_m(t + 1e-3, 1) - z_m(t - 1e-3, 1)) / 2e-3;
    EXPECT_NEAR(at(t, 1).desired_foot_velocity_m_s[2], lifted, 2e-3);
    EXPECT_GE(rate, 0.0) << "the body never rises";
    fastest_m_s = std::max(fastest_m_s, rate);
  }
  EXPECT_LE(fastest_m_s, 0.35);
}

TEST_F(LoweringTest, EndsByItself) {
  ASSERT_TRUE(lowering_.begin(last_, state_));
  at(kLowering_s - 0.001, 0);
  EXPECT_TRUE(lowering_.running());
  at(kLowering_s, 0);
  EXPECT_FALSE(lowering_.running());
}

TEST_F(LoweringTest, ShortLegsStayShort) {
  for (EstimatedLeg& leg : state_.legs) leg.estimated_foot_in_hip_m = {0, 0, -0.2};
  ASSERT_TRUE(lowering_.begin(last_, state_));
  EXPECT_EQ(z_m(1.0, 0), -0.2);
}

TEST_F(LoweringTest, WhatFliesThrustsIsDampedOrUnknownIsNotLowered) {
  const LegCommand standing = last_;
  for (LegPhase phase : {LegPhase::kThrust, LegPhase::kFlight}) {
    last_.legs[1].phase = phase;
    EXPECT_FALSE(lowering_.begin(last_, state_)) << name(phase);
    last_ = standing;
  }
  for (ControlMode mode : {ControlMode::kDisabled, ControlMode::kDamping, ControlMode::kJoint}) {
    last_.legs[1].control_mode = mode;
    EXPECT_FALSE(lowering_.begin(last_, state_)) << name(mode);
    last_ = standing;
  }
  ASSERT_TRUE(lowering_.begin(last_, state_));
  state_.legs[0].estimated_foot_in_hip_m[1] = kNaN;
  EXPECT_FALSE(lowering_.begin(last_, state_));
  EXPECT_FALSE(lowering_.running());
}

}  // namespace
}  // namespace sprung
