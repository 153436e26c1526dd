#include "estimator/rotation.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

TEST(Rotation, ByAVectorTurnsAboutItByItsLength) {
  EXPECT_NEAR((turned_by({0, 0, 0.5 * M_PI}) * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(),
              0.0, 1e-15);
  EXPECT_EQ(turned_by({0, 0, 0}).w(), 1.0);
}

TEST(Rotation, SmallTurnsAreNotLost) {
  const Eigen::Quaterniond q = turned_by({1e-9, 0, 0});
  EXPECT_NEAR(q.x(), 0.5e-9, 1e-18);
}

TEST(Rotation, YawIsPositiveToTheLeftAndTiltHasNoPartInIt) {
  const Eigen::Quaterniond q = turned_by({0, 0, 0.7}) * turned_by({0, 0.3, 0});
  EXPECT_NEAR(yaw_rad(q), 0.7, 1e-12);
  EXPECT_NEAR(tilt_rad(q), 0.3, 1e-12);
  EXPECT_NEAR(yaw_rad(turned_about_z(-2.0)), -2.0, 1e-12);
}

}  // namespace
}  // namespace sprung
