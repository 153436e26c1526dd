#include "planner/gait/force_distribution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tests/support/allocation_count.h"

namespace sprung {
namespace {

constexpr double kFriction = 0.5;
constexpr double kWeight_N = 294.0;
const BodyWrench kStand{{0.0, 0.0, kWeight_N}, Eigen::Vector3d::Zero()};

/// FL, FR, HL, HR of a robot like pegasus, standing.
std::vector<FootLoad> four_feet() {
  std::vector<FootLoad> feet(4);
  for (int i = 0; i < 4; ++i)
    feet[i] = {{i < 2 ? 0.35 : -0.35, i % 2 == 0 ? 0.2 : -0.2, -0.45}, 250.0, 5.0, true};
  return feet;
}

void expect_inside_bounds(const DistributedForce& out, const std::vector<FootLoad>& feet) {
  for (std::size_t i = 0; i < feet.size(); ++i) {
    const Eigen::Vector3d& force = out.ground_on_foot_N[i];
    ASSERT_TRUE(force.allFinite());
    if (!feet[i].stands) {
      ASSERT_EQ(force, Eigen::Vector3d::Zero());
      continue;
    }
    const double most_N = std::max(0.0, feet[i].most_N);
    ASSERT_LE(force.z(), most_N);
    ASSERT_GE(force.z(), std::clamp(feet[i].least_N, 0.0, most_N));
    ASSERT_LE(force.head<2>().norm(), kFriction * force.z() * (1.0 + 1e-12));
  }
}

TEST(ForceDistribution, FourFeetShareTheWeightEqually) {
  ForceDistribution distribution(kFriction);
  const DistributedForce& out = distribution.solve(kStand, four_feet());
  EXPECT_EQ(out.status, ForceStatus::kExact);
  expect_inside_bounds(out, four_feet());
  for (const Eigen::Vector3d& force : out.ground_on_foot_N)
    EXPECT_LT((force - Eigen::Vector3d(0.0, 0.0, kWeight_N / 4.0)).norm(), 0.01);
}

TEST(ForceDistribution, NoFeetAndNumbersThatAreNoneGiveNoForce) {
  ForceDistribution distribution(kFriction);
  std::vector<FootLoad> feet = four_feet();
  const auto expect_zero = [&](ForceStatus status, const BodyWrench& wanted) {
    const DistributedForce& out = distribution.solve(wanted, feet);
    EXPECT_EQ(out.status, status);
    for (const Eigen::Vector3d& force : out.ground_on_foot_N) EXPECT_EQ(force, Eigen::Vector3d::Zero());
    EXPECT_EQ(out.reached.force_N, Eigen::Vector3d::Zero());
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  distribution.solve(kStand, feet);
  expect_zero(ForceStatus::kInvalid, {{0.0, nan, kWeight_N}, Eigen::Vector3d::Zero()});
  expect_zero(ForceStatus::kInvalid, {kStand.force_N, {0.0, 0.0, std::numeric_limits<double>::infinity()}});
  feet[2].most_N = nan;
  expect_zero(ForceStatus::kInvalid, kStand);
  feet[2].stands = false;  // nobody reads it then
  feet[1].least_N = 0.0;   // the com is on the line between the two others
  EXPECT_EQ(distribution.solve(kStand, feet).status, ForceStatus::kExact);
  for (FootLoad& foot : feet) foot.stands = false;
  expect_zero(ForceStatus::kNoFeet, kStand);
  feet.assign(5, FootLoad{});
  expect_zero(ForceStatus::kInvalid, kStand);
}

}  // namespace
}  // namespace sprung
