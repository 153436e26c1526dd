#include "estimator/torque_bound.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sprung {
namespace {

JointConfig joint() {
  JointConfig j;
  j.armature_kg_m2 = 0.5;
  j.uncertainty = {0.1, 0.02, 0.05, 0.06};
  return j;
}

TEST(TorqueBoundTest, NothingUncertainIsNoBound) {
  EXPECT_EQ(torque_bounds(joint(), {}).gear_output_Nm, 0.0);
  EXPECT_EQ(torque_bounds(joint(), {}).friction_Nm, 0.0);
}

TEST(TorqueBoundTest, EachCauseAloneIsTimesItsStandardDeviations) {
  TorqueBoundInput in;
  in.friction_std_Nm = 0.8;
  EXPECT_NEAR(torque_bounds(joint(), in).gear_output_Nm, kModelStds * 0.8, 1e-12);
  EXPECT_NEAR(torque_bounds(joint(), in).friction_Nm, kModelStds * 0.8, 1e-12);
  in = {};
  in.motor_torque_Nm = -100.0;
  EXPECT_NEAR(torque_bounds(joint(), in).gear_output_Nm, kModelStds * 2.0, 1e-12);
  EXPECT_EQ(torque_bounds(joint(), in).friction_Nm, 0.0);
  in = {};
  in.acceleration_rad_s2 = -200.0;
  EXPECT_NEAR(torque_bounds(joint(), in).gear_output_Nm, kModelStds * 0.05 * 0.5 * 200.0, 1e-12);
  in = {};
  in.filter_std_rad_s2 = 3.0;
  EXPECT_NEAR(torque_bounds(joint(), in).gear_output_Nm, kFilterStds * 1.5, 1e-12);
  in = {};
  in.filter_step_rad_s2 = -3.0;
  EXPECT_NEAR(torque_bounds(joint(), in).gear_output_Nm, kFilterStds * 1.5, 1e-12);
}

TEST(TorqueBoundTest, IndependentCausesAddTheirSquares) {
  TorqueBoundInput in;
  in.friction_std_Nm = 3.0;
  in.motor_torque_Nm = 200.0;  // 4 Nm
  EXPECT_NEAR(torque_bounds(joint(), in).gear_output_Nm, kModelStds * 5.0, 1e-12);
}

TEST(TorqueBoundTest, FrictionThatFollowsTheLoadTakesItsShareOfTheModelsErrors) {
  TorqueBoundInput in;
  in.motor_torque_Nm = 100.0;
  in.by_friction = 0.8;
  EXPECT_NEAR(torque_bounds(joint(), in).gear_output_Nm, 0.8 * kModelStds * 2.0, 1e-12);
}

TEST(TorqueBoundTest, AtRestAllThatTheGearCanHoldIsInIt) {
  TorqueBoundInput in;
  in.rest_distance_Nm = 12.0;
  EXPECT_DOUBLE_EQ(torque_bounds(joint(), in).gear_output_Nm, 12.0);
  in.friction_std_Nm = 0.8;
  EXPECT_NEAR(torque_bounds(joint(), in).gear_output_Nm, std::hypot(12.0, kModelStds * 0.8), 1e-12);
}

}  // namespace
}  // namespace sprung
