#include "estimator/torque_bound.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

JointConfig joint() {
  JointConfig j;
  j.coulomb_friction_Nm = 2.0;
  j.armature_kg_m2 = 0.5;
  return j;
}

TEST(TorqueBoundTest, AtRestFrictionMayHaveEitherSign) {
  TorqueBoundInput in;
  EXPECT_DOUBLE_EQ(torque_bound_Nm(joint(), in), 2.0 * (1.0 + kFrictionUncertainty));
  in.friction_torque_Nm = -2.0;  // moving: the sign is known
  EXPECT_DOUBLE_EQ(torque_bound_Nm(joint(), in), 2.0 * kFrictionUncertainty);
}

TEST(TorqueBoundTest, EveryTermAddsItsShareWhateverItsSign) {
  TorqueBoundInput in;
  in.motor_torque_Nm = -100.0;
  in.friction_torque_Nm = 2.0;
  in.acceleration_rad_s2 = -200.0;
  in.acceleration_std_rad_s2 = 3.0;
  in.output_torque_rate_Nm_s = -1000.0;
  in.lag_s = 0.002;
  in.current_quantisation_Nm = 0.25;
  const double expected = 2.0 * kFrictionUncertainty + 100.0 * kTorqueConstantUncertainty + 0.25 +
                          0.5 * (kArmatureUncertainty * 200.0 + 2.0 * 3.0) + 2.0;
  EXPECT_NEAR(torque_bound_Nm(joint(), in), expected, 1e-12);
}

}  // namespace
}  // namespace sprung
