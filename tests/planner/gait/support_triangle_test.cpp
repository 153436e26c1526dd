#include "planner/gait/support_triangle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sprung {
namespace {

using SupportTriangleFeet = std::array<Eigen::Vector2d, 3>;
const SupportTriangleFeet kRight{Eigen::Vector2d(0, 0), Eigen::Vector2d(0.4, 0),
                                 Eigen::Vector2d(0, 0.3)};  // inradius 0.1

TEST(SupportTriangleTest, MarginIsTheDistanceFromTheNearestSideWhateverTheOrderOfFeet) {
  for (const SupportTriangleFeet& feet : {kRight, SupportTriangleFeet{kRight[1], kRight[0], kRight[2]}}) {
    const SupportTriangle triangle(feet);
    EXPECT_NEAR(triangle.margin_m({0.1, 0.1}), 0.1, 1e-12);
    EXPECT_NEAR(triangle.margin_m({0.05, 0.02}), 0.02, 1e-12);
    EXPECT_NEAR(triangle.margin_m({0.1, -0.03}), -0.03, 1e-12);
  }
}

TEST(SupportTriangleTest, ASafePlaceIsLeft) {
  EXPECT_EQ(SupportTriangle(kRight).safe_place_m({0.1, 0.08}, 0.05), Eigen::Vector2d(0.1, 0.08));
}

TEST(SupportTriangleTest, TheWayEndsWhereTheMarginIsReached) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-0.5, 0.5);
  const SupportTriangle triangle(kRight);
  for (int k = 0; k < 200; ++k) {
    const Eigen::Vector2d from_m(place(random), place(random));
    const Eigen::Vector2d to_m = triangle.safe_place_m(from_m, 0.06);
    if (triangle.margin_m(from_m) >= 0.06) {
      EXPECT_EQ(to_m, from_m);
    } else {
      EXPECT_NEAR(triangle.margin_m(to_m), 0.06, 1e-9);
    }
  }
}

TEST(SupportTriangleTest, WithoutSuchAMarginTheMiddleIsTheSafest) {
  EXPECT_TRUE(SupportTriangle(kRight).safe_place_m({1.0, 1.0}, 0.2).isApprox(Eigen::Vector2d(0.1, 0.1)));
}

TEST(SupportTriangleTest, FeetInALineLeaveNoSafePlaceAndNoNonsense) {
  const SupportTriangle line({Eigen::Vector2d(0, 0), Eigen::Vector2d(0.2, 0), Eigen::Vector2d(0.4, 0)});
  EXPECT_LE(line.margin_m({0.2, 0.01}), 0.0);
  EXPECT_TRUE(line.safe_place_m({0.2, 0.3}, 0.05).allFinite());
  const SupportTriangle spot({Eigen::Vector2d(0, 0), Eigen::Vector2d(0, 0), Eigen::Vector2d(0, 0)});
  EXPECT_TRUE(std::isfinite(spot.margin_m({0.1, 0.1})) && spot.safe_place_m({0.1, 0.1}, 0.05).allFinite());
}

}  // namespace
}  // namespace sprung
