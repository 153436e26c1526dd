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

TEST(TorqueBoundTest, AtRestOnlyFrictionIsUnknown) {
  const TorqueBound bound = torque_bound(joint(), {});
  EXPECT_DOUBLE_EQ(bound.static_Nm, kFrictionUncertainty * 2.0);
  EXPECT_DOUBLE_EQ(bound.dynamic_Nm, 0.0);
}

TEST(TorqueBoundTest, EveryTermAddsItsShareWhateverItsSign) {
  TorqueBoundInput in;
  in.motor_torque_Nm = -100.0;
  in.acceleration_rad_s2 = -200.0;
  in.acceleration_std_rad_s2 = 3.0;
  in.output_torque_rate_Nm_s = -1000.0;
  in.lag_s = 0.002;
  in.current_quantisation_Nm = 0.25;
  const TorqueBound bound = torque_bound(joint(), in);
  EXPECT_NEAR(bound.static_Nm, 2.0 * kFrictionUncertainty + 100.0 * kTorqueConstantUncertainty + 0.25, 1e-12);
  EXPECT_NEAR(bound.dynamic_Nm, 0.5 * (kArmatureUncertainty * 200.0 + 2.0 * 3.0) + 2.0, 1e-12);
  EXPECT_DOUBLE_EQ(bound.total_Nm(), bound.static_Nm + bound.dynamic_Nm);
}

}  // namespace
}  // namespace sprung
