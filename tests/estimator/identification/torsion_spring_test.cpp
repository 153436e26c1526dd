#include <gtest/gtest.h>

#include <stdexcept>

#include "estimator/identification/footprint.h"

namespace sprung::identification {
namespace {

/// LARA8 joint 3, from its data sheet.
TorsionSpring lara8() { return TorsionSpring({{0.0, 31e3}, {14.0, 50e3}, {48.0, 57e3}}); }

TEST(TorsionSpring, StagesLieOnTopOfEachOther) {
  EXPECT_NEAR(lara8().angle_rad(14.0), 14.0 / 31e3, 1e-15);
  EXPECT_NEAR(lara8().angle_rad(48.0), 14.0 / 31e3 + 34.0 / 50e3, 1e-15);
  EXPECT_NEAR(lara8().angle_rad(105.0), 14.0 / 31e3 + 34.0 / 50e3 + 57.0 / 57e3, 1e-15);
}

TEST(TorsionSpring, IsTheSameBothWays) {
  for (const double torque : {1.0, 20.0, 90.0})
    EXPECT_EQ(lara8().angle_rad(-torque), -lara8().angle_rad(torque));
  EXPECT_EQ(lara8().angle_rad(0.0), 0.0);
}

TEST(TorsionSpring, AngleAndTorqueInvertEachOther) {
  for (double torque = -120.0; torque <= 120.0; torque += 0.7)
    EXPECT_NEAR(lara8().torque_Nm(lara8().angle_rad(torque)), torque, 1e-9);
}

TEST(TorsionSpring, OneStageIsHookesLaw) {
  const TorsionSpring spring({{0.0, 2.5e4}});
  EXPECT_DOUBLE_EQ(spring.torque_Nm(1e-3), 25.0);
}

TEST(TorsionSpring, RefusesStagesThatCannotBe) {
  EXPECT_THROW(TorsionSpring({}), std::invalid_argument);
  EXPECT_THROW(TorsionSpring({{1.0, 1e4}}), std::invalid_argument);
  EXPECT_THROW(TorsionSpring({{0.0, 0.0}}), std::invalid_argument);
  EXPECT_THROW(TorsionSpring({{0.0, 1e4}, {0.0, 2e4}}), std::invalid_argument);
}

}  // namespace
}  // namespace sprung::identification
