#include "model/friction/coulomb_friction.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

TEST(CoulombFrictionTest, NoneAtRest) {
  EXPECT_EQ(papers_friction_Nm(1.79, 0.0), 0.0);  // errata E5
}

TEST(CoulombFrictionTest, FullAndOddWhenMoving) {
  EXPECT_NEAR(papers_friction_Nm(1.79, 1.0), 1.79, 1e-12);
  EXPECT_EQ(papers_friction_Nm(1.79, -0.03), -papers_friction_Nm(1.79, 0.03));
}

TEST(CoulombFrictionTest, SlopeAtRestIsTorqueOverTwentyMilliradiansPerSecond) {
  EXPECT_NEAR(papers_friction_Nm(2.0, 1e-6) / 1e-6, 100.0, 1e-6);
}

}  // namespace
}  // namespace sprung
