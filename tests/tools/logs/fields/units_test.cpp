#include "tools/logs/fields/units.h"

#include <gtest/gtest.h>

namespace sprung::fields {
namespace {

TEST(Units, AreReadFromTheEndOfTheName) {
  EXPECT_EQ(unit_of("estimated_position_rad"), "rad");
  EXPECT_EQ(unit_of("joint_speed_rad_s"), "rad/s");
  EXPECT_EQ(unit_of("joint_acceleration_rad_s2"), "rad/s2");
  EXPECT_EQ(unit_of("commanded_damping_Nm_s_rad"), "Nm s/rad");
  EXPECT_EQ(unit_of("gear_output_torque_Nm"), "Nm");
  EXPECT_EQ(unit_of("stiffness_N_m"), "N/m");
  EXPECT_EQ(unit_of("damping_N_s_m"), "N s/m");
  EXPECT_EQ(unit_of("foot_force_N"), "N");
  EXPECT_EQ(unit_of("estimated_foot_in_hip_m"), "m");
  EXPECT_EQ(unit_of("loop_period_max_us"), "us");
  EXPECT_EQ(unit_of("valid_until_utime"), "us");
  EXPECT_EQ(unit_of("utime"), "us");
  EXPECT_EQ(unit_of("memory_kB"), "kB");
  EXPECT_EQ(unit_of("position_covariance_m2"), "m2");
  EXPECT_EQ(unit_of("attitude_covariance_rad2"), "rad2");
  EXPECT_EQ(unit_of("velocity_covariance_m2_s2"), "m2/s2");
}

TEST(Units, NamesWithoutOneHaveNone) {
  for (const char* name : {"seq", "n_joints", "status", "legs", "m", "_m", "names", "problem"})
    EXPECT_EQ(unit_of(name), "") << name;
}

TEST(Units, OfMixedListsGoByIndex) {
  EXPECT_EQ(unit_of("wrench", 2), "N");
  EXPECT_EQ(unit_of("wrench", 3), "Nm");
  EXPECT_EQ(unit_of("desired_speed", 1), "m/s");
  EXPECT_EQ(unit_of("walk_speed", 2), "rad/s");
}

}  // namespace
}  // namespace sprung::fields
