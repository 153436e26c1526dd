#include "model/friction/coulomb_friction.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

TEST(CoulombFrictionTest, NoneAtRestAndSaysSo) {
  const FrictionEstimate rest = coulomb_friction(1.79, 0.0, 0.02);
  EXPECT_EQ(rest.torque_Nm, 0.0);  // errata E5
  EXPECT_TRUE(rest.at_rest);
}

TEST(CoulombFrictionTest, FullAndOddWhenMoving) {
  EXPECT_NEAR(coulomb_friction(1.79, 1.0, 0.02).torque_Nm, 1.79, 1e-12);
  EXPECT_EQ(coulomb_friction(1.79, -0.03, 0.02).torque_Nm, -coulomb_friction(1.79, 0.03, 0.02).torque_Nm);
  EXPECT_FALSE(coulomb_friction(1.79, 0.03, 0.02).at_rest);
}

TEST(CoulombFrictionTest, ThePapersIsSmoothedOverTwentyMilliradiansPerSecond) {
  EXPECT_EQ(papers_friction(1.79, -0.013).torque_Nm, coulomb_friction(1.79, -0.013, 0.02).torque_Nm);
}

TEST(CoulombFrictionTest, SlopeAtRestIsTorqueOverSmoothing) {
  EXPECT_NEAR(coulomb_friction(2.0, 1e-6, 0.05).torque_Nm / 1e-6, 40.0, 1e-6);
}

}  // namespace
}  // namespace sprung
