#include "planner/gait/payload_estimator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "model/leg_kinematics.h"
#include "robots/robot_loader.h"
#include "tests/planner/gait/standing_robot.h"

namespace sprung {
namespace {

constexpr double kStep_s = 0.002;

/// pegasus over four feet under its hips; what they press is what a load demands.
class PayloadEstimatorTest : public testing::Test {
 protected:
  PayloadEstimatorTest() {
    for (EstimatedLeg& leg : in_.legs) leg.foot_force_bound_N = {10.0, 10.0, 10.0};
  }

  /// Statics of four feet at the corners of a rectangle, lifted by an acceleration; the trunk's speed
  /// follows.
  void press(double mass_kg, double x_m, double y_m, double up_m_s2, double too_much_N = 0.0) {
    in_.stamp.utime_us += 2000;
    up_m_s_ += up_m_s2 * kStep_s;
    in_.body.estimated_velocity_m_s = {0.0, 0.0, up_m_s_};
    const double force_N = mass_kg * (kGravity_m_s2 + up_m_s2);
    const BodyView view = BodyView::of(in_, shape_);
    for (std::size_t i = 0; i < 4; ++i) {
      const double share = 0.25 * (1.0 + x_m / view.foot_m[i].x()) * (1.0 + y_m / view.foot_m[i].y());
      in_.legs[i].foot_force_N = {0.0, 0.0, share * force_N + too_much_N / 4.0};
    }
  }
  /// Half of the time it gathers speed, half it brakes.
  void rise(double mass_kg, double x_m, double y_m, double too_much_N = 0.0) {
    up_m_s_ = 0.0;
    for (int i = 0; i < 500; ++i) {
      press(mass_kg, x_m, y_m, i < 250 ? 0.4 : -0.4, too_much_N);
      payload_.add_rise(in_);
    }
  }
  bool period(double mass_kg, double x_m, double y_m, const std::function<double(int)>& friction_N) {
    for (int i = 0; i < 400; ++i) {
      press(mass_kg, x_m, y_m, 0.0, friction_N(i));
      payload_.add(in_, BodyView::of(in_, shape_));
    }
    return payload_.period_ended();
  }

  const RobotConfig robot_ = load_robot("pegasus");
  const BodyShape shape_{robot_};
  PayloadEstimator payload_{robot_};
  JointState in_ = test::standing(robot_);
  double up_m_s_ = 0.0;
};

TEST_F(PayloadEstimatorTest, NothingIsKnownBeforeItHasStoodUp) {
  EXPECT_TRUE(std::isnan(payload_.estimate().mass_kg));
  EXPECT_EQ(payload_.used().mass_kg, 0.0);
  EXPECT_TRUE(payload_.used().com_shift_m.isZero());
}

TEST_F(PayloadEstimatorTest, RiseShowsMassAndPlace) {
  rise(36.0, 0.04, -0.01);  // 6 kg at 0.24, -0.06
  ASSERT_TRUE(payload_.rise_ended());
  const EstimatedPayload found = payload_.estimate();
  EXPECT_NEAR(found.mass_kg, 6.0, 0.05);
  EXPECT_NEAR(found.mass_bound_kg, 20.0 / kGravity_m_s2, 0.01) << "root of the sum of four squares of 10 N";
  EXPECT_NEAR(found.in_trunk_m[0], 0.24, 0.005);
  EXPECT_NEAR(found.in_trunk_m[1], -0.06, 0.005);
}

TEST_F(PayloadEstimatorTest, WhatIsWithinItsBoundIsNoPayloadButTheMiddleOfMassIsStillUsed) {
  rise(31.0, 0.015, 0.0);
  ASSERT_TRUE(payload_.rise_ended());
  EXPECT_NEAR(payload_.estimate().mass_kg, 1.0, 0.05);
  EXPECT_TRUE(std::isnan(payload_.estimate().in_trunk_m[0]));
  EXPECT_EQ(payload_.used().mass_kg, 0.0);
  EXPECT_NEAR(payload_.used().com_shift_m.x(), 0.015, 1e-3);
}

TEST_F(PayloadEstimatorTest, LawsUseWhatIsBeyondTheBound) {
  rise(36.0, 0.0, 0.0);
  ASSERT_TRUE(payload_.rise_ended());
  EXPECT_NEAR(payload_.used().mass_kg, 6.0 - 20.0 / kGravity_m_s2, 0.06);
}

TEST_F(PayloadEstimatorTest, RobotThatHangsOrLiesIsNotWeighed) {
  rise(10.0, 0.0, 0.0);
  EXPECT_FALSE(payload_.rise_ended());
  EXPECT_TRUE(std::isnan(payload_.estimate().mass_kg));
  in_.body.estimated_height_m = robot_.body.fallen_height_m - 0.01;  // its belly may carry a part
  rise(30.0, 0.0, 0.0);
  EXPECT_FALSE(payload_.rise_ended());
}

TEST_F(PayloadEstimatorTest, WhatHasNoNumbersIsNotWeighed) {
  rise(36.0, 0.0, 0.0);
  in_.stamp.utime_us += 2000;
  in_.legs[2].foot_force_N = {kNaN, kNaN, kNaN};
  payload_.add_rise(in_);
  EXPECT_FALSE(payload_.rise_ended());
}

TEST_F(PayloadEstimatorTest, FrictionThatIsWrongInOneDirectionIsMendedByAGaitThatGoesBothWays) {
  rise(36.0, 0.0, 0.0, 20.0);
  ASSERT_TRUE(payload_.rise_ended());
  EXPECT_GT(payload_.estimate().mass_kg, 7.9);
  payload_.begin_anew();
  for (int i = 0; i < 6; ++i) {
    const auto friction_N = [](int k) { return k % 100 < 50 ? 20.0 : -20.0; };
    EXPECT_TRUE(period(36.0, 0.04, 0.0, friction_N));
  }
  EXPECT_NEAR(payload_.estimate().mass_kg, 6.0, 0.1);
  EXPECT_NEAR(payload_.used().com_shift_m.x(), 0.04, 0.004);
  EXPECT_LT(payload_.estimate().mass_bound_kg, 1.0);
}

TEST_F(PayloadEstimatorTest, PeriodThatLastedTooLongSaysNothing) {
  rise(36.0, 0.0, 0.0);
  ASSERT_TRUE(payload_.rise_ended());
  const double before_kg = payload_.estimate().mass_kg;
  for (int i = 0; i < 7000; ++i) {
    press(33.0, 0.0, 0.0, 0.0);
    payload_.add(in_, BodyView::of(in_, shape_));
  }
  EXPECT_FALSE(payload_.period_ended());
  EXPECT_EQ(payload_.estimate().mass_kg, before_kg);
}

TEST_F(PayloadEstimatorTest, NextRiseBeginsWithNothing) {
  rise(36.0, 0.0, 0.0);
  ASSERT_TRUE(payload_.rise_ended());
  payload_.forget();
  EXPECT_TRUE(std::isnan(payload_.estimate().mass_kg));
}

}  // namespace
}  // namespace sprung
