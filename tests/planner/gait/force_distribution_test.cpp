#include "planner/gait/force_distribution.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
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

bool chance(std::mt19937& random) { return std::uniform_real_distribution<>(0.0, 1.0)(random) < 0.75; }

double force_distribution_between(double least, double most, std::mt19937& random) {
  return std::uniform_real_distribution<>(least, most)(random);
}

Eigen::Vector3d vector_within(double x, double y, double z, std::mt19937& random) {
  const double at_x = force_distribution_between(-x, x, random),
               at_y = force_distribution_between(-y, y, random);
  return {at_x, at_y, force_distribution_between(-z, z, random)};
}

/// Feet anywhere about their places, some in the air, some with the load of a foot that has just landed.
std::vector<FootLoad> random_feet(std::mt19937& random) {
  std::vector<FootLoad> feet = four_feet();
  for (FootLoad& foot : feet) {
    foot.foot_from_com_m += vector_within(0.1, 0.1, 0.05, random);
    foot.stands = chance(random);
    foot.most_N = chance(random) ? force_distribution_between(50.0, 300.0, random)
                                 : force_distribution_between(-5.0, 20.0, random);
    foot.least_N = chance(random) ? force_distribution_between(0.0, 20.0, random) : 0.0;
  }
  return feet;
}

/// Some within reach, most not.
BodyWrench random_wrench(std::mt19937& random) {
  BodyWrench wrench{vector_within(80.0, 80.0, 150.0, random), vector_within(40.0, 40.0, 20.0, random)};
  wrench.force_N.z() += kWeight_N;
  return wrench;
}

/// What the header says is smallest, reckoned with cross products and not with matrices.
double cost_of(const std::array<Eigen::Vector3d, 4>& forces, const BodyWrench& wanted,
               const std::vector<FootLoad>& feet, const ForceWeights& weights) {
  Eigen::Vector3d force = -wanted.force_N, torque = -wanted.torque_Nm;
  double squares = 0.0;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    force += forces[i];
    torque += feet[i].foot_from_com_m.cross(forces[i]);
    squares += forces[i].squaredNorm();
  }
  return weights.horizontal_force * force.head<2>().squaredNorm() +
         weights.vertical_force * force.z() * force.z() +
         weights.roll_pitch_torque * torque.head<2>().squaredNorm() +
         weights.yaw_torque * torque.z() * torque.z() + weights.foot_force * squares;
}

/// A force that the foot may have: inside the eight-sided pyramid, whose corners are on the cone.
Eigen::Vector3d allowed_force(const FootLoad& foot, std::mt19937& random) {
  if (!foot.stands) return Eigen::Vector3d::Zero();
  const double most_N = std::max(0.0, foot.most_N);
  const double vertical = force_distribution_between(std::clamp(foot.least_N, 0.0, most_N), most_N, random);
  const double inner = kFriction * std::cos(M_PI / 8.0) * vertical;  // the circle inside the pyramid
  const double angle = force_distribution_between(0.0, 2.0 * M_PI, random),
               share = force_distribution_between(0.0, 1.0, random);
  return {share * inner * std::cos(angle), share * inner * std::sin(angle), vertical};
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
  expect_zero(ForceStatus::kInvalid, {kStand.force_N, {1e308, 0.0, 0.0}});  // overflows on the way
  feet[3].foot_from_com_m.x() = 1e200;
  expect_zero(ForceStatus::kInvalid, kStand);
  feet = four_feet();
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

TEST(ForceDistribution, BoundsAndConesAreKeptWhateverIsAsked) {
  ForceDistribution distribution(kFriction);
  std::mt19937 random(1);
  int bounded = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    const std::vector<FootLoad> feet = random_feet(random);
    const DistributedForce& out = distribution.solve(random_wrench(random), feet);
    ASSERT_NE(out.status, ForceStatus::kInvalid);
    expect_inside_bounds(out, feet);
    bounded += out.status == ForceStatus::kBounded;
  }
  EXPECT_GT(bounded, 1000);
  EXPECT_LT(bounded, 4990);
}

/// A convex cost is smallest where no way towards any allowed force goes down.
TEST(ForceDistribution, NoAllowedForcesAreBetter) {
  const ForceWeights weights;
  ForceDistribution distribution(kFriction, weights);
  std::mt19937 random(2);
  for (int trial = 0; trial < 300; ++trial) {
    const std::vector<FootLoad> feet = random_feet(random);
    const BodyWrench wanted = random_wrench(random);
    const auto found = distribution.solve(wanted, feet).ground_on_foot_N;
    const double cost = cost_of(found, wanted, feet, weights);
    for (int other = 0; other < 60; ++other) {
      auto forces = found;
      const double step = std::pow(10.0, force_distribution_between(-4.0, 0.0, random));
      for (std::size_t i = 0; i < feet.size(); ++i) {
        if (chance(random)) forces[i] += step * (allowed_force(feet[i], random) - forces[i]);
      }
      ASSERT_GE(cost_of(forces, wanted, feet, weights), cost - 1e-7 * (1.0 + cost)) << trial;
    }
  }
}

TEST(ForceDistribution, WhatItSaysIsReachedIsWhatTheForcesDo) {
  ForceDistribution distribution(kFriction);
  std::mt19937 random(3);
  for (int trial = 0; trial < 500; ++trial) {
    const std::vector<FootLoad> feet = random_feet(random);
    const DistributedForce& out = distribution.solve(random_wrench(random), feet);
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), torque = Eigen::Vector3d::Zero();
    for (std::size_t i = 0; i < feet.size(); ++i) {
      force += out.ground_on_foot_N[i];
      torque += feet[i].foot_from_com_m.cross(out.ground_on_foot_N[i]);
    }
    ASSERT_LT((force - out.reached.force_N).norm() + (torque - out.reached.torque_Nm).norm(), 1e-9);
  }
}

TEST(ForceDistribution, AWrenchWithinReachIsReached) {
  ForceDistribution distribution(kFriction);
  const BodyWrench wanted{{20.0, -10.0, kWeight_N}, {8.0, -6.0, 4.0}};
  const DistributedForce& out = distribution.solve(wanted, four_feet());
  EXPECT_EQ(out.status, ForceStatus::kExact);
  EXPECT_LT((out.reached.force_N - wanted.force_N).norm(), 0.05);
  EXPECT_LT((out.reached.torque_Nm - wanted.torque_Nm).norm(), 0.01);
}

TEST(ForceDistribution, FrictionLimitsWhatPushesForward) {
  ForceDistribution distribution(kFriction);
  const DistributedForce& out = distribution.solve({{400.0, 0.0, kWeight_N}, Eigen::Vector3d::Zero()},
                                                   four_feet());
  EXPECT_EQ(out.status, ForceStatus::kBounded);
  EXPECT_NEAR(out.reached.force_N.x(), kFriction * out.reached.force_N.z(),
              1e-6);                             // all of it, along an axis
  EXPECT_LT(out.reached.torque_Nm.norm(), 1.0);  // and not by pitching the body over its hind feet
}

TEST(ForceDistribution, HeightAndLevelComeBeforePlaceAndHeadingUnlessWeightsSayElse) {
  std::vector<FootLoad> feet = four_feet();
  for (FootLoad& foot : feet) foot.most_N = 80.0;
  const BodyWrench wanted{{200.0, 0.0, kWeight_N}, {0.0, 0.0, 60.0}};
  ForceDistribution usual(kFriction);
  const BodyWrench level = usual.solve(wanted, feet).reached;
  ForceDistribution turned_round(kFriction, {1.0, 0.1, 1.0, 20.0, 1e-4});
  const BodyWrench pushing = turned_round.solve(wanted, feet).reached;
  // The push alone pitches the body with 60 Nm and more.
  EXPECT_LT(level.torque_Nm.head<2>().norm(), 2.0);
  EXPECT_GT(level.force_N.z(), 0.95 * kWeight_N);
  EXPECT_GT(pushing.torque_Nm.head<2>().norm(), 5.0 * level.torque_Nm.head<2>().norm());
  EXPECT_GT(pushing.force_N.x(), level.force_N.x() + 5.0);
}

TEST(ForceDistribution, TwoFeetOnADiagonalCarryTheWeight) {
  ForceDistribution distribution(kFriction);
  std::vector<FootLoad> feet = four_feet();
  feet[0].stands = feet[3].stands = false;
  const DistributedForce& out = distribution.solve(kStand, feet);
  EXPECT_EQ(out.status, ForceStatus::kExact);
  expect_inside_bounds(out, feet);
  EXPECT_NEAR(out.ground_on_foot_N[1].z(), kWeight_N / 2.0, 0.02);
  EXPECT_NEAR(out.ground_on_foot_N[2].z(), kWeight_N / 2.0, 0.02);
}

/// About the line between two feet the body turns only if they push it sideways: force times height. So both
/// can't be had, and the weights decide: by default level comes first.
TEST(ForceDistribution, TwoFeetTurnTheBodyAboutTheirLineByPushingSideways) {
  std::vector<FootLoad> feet = four_feet();
  feet[0].stands = feet[3].stands = false;
  const Eigen::Vector3d line = (feet[1].foot_from_com_m - feet[2].foot_from_com_m).normalized();
  const BodyWrench wanted{kStand.force_N, 10.0 * line};
  ForceDistribution level_first(kFriction);
  const DistributedForce& leveled = level_first.solve(wanted, feet);
  EXPECT_EQ(leveled.status, ForceStatus::kBounded);
  EXPECT_NEAR(leveled.reached.torque_Nm.dot(line), 10.0, 0.5);
  EXPECT_NEAR(leveled.reached.force_N.head<2>().norm(), 10.0 / 0.45, 1.0);
  ForceWeights place;
  place.horizontal_force = 100.0;
  ForceDistribution place_first(kFriction, place);
  EXPECT_LT(place_first.solve(wanted, feet).reached.force_N.head<2>().norm(), 1.5);
}

TEST(ForceDistribution, OneFootBelowTheComCarriesAllThatItMay) {
  ForceDistribution distribution(kFriction);
  std::vector<FootLoad> feet(1);
  feet[0] = {{0.0, 0.0, -0.45}, 500.0, 0.0, true};
  EXPECT_EQ(distribution.solve(kStand, feet).status, ForceStatus::kExact);
  feet[0].most_N = 100.0;
  const DistributedForce& out = distribution.solve(kStand, feet);
  EXPECT_EQ(out.status, ForceStatus::kBounded);
  EXPECT_DOUBLE_EQ(out.ground_on_foot_N[0].z(), 100.0);
}

TEST(ForceDistribution, FeetInOneLineOrInOnePlaceShareTheWeight) {
  ForceDistribution distribution(kFriction);
  std::vector<FootLoad> feet = four_feet();
  for (FootLoad& foot : feet) foot.foot_from_com_m.y() = 0.0;
  EXPECT_EQ(distribution.solve(kStand, feet).status, ForceStatus::kExact);
  for (FootLoad& foot : feet) foot.foot_from_com_m.x() = 0.0;
  const DistributedForce& out = distribution.solve(kStand, feet);
  EXPECT_EQ(out.status, ForceStatus::kExact);
  for (const Eigen::Vector3d& force : out.ground_on_foot_N) EXPECT_NEAR(force.z(), kWeight_N / 4.0, 0.01);
}

/// A foot that lands or leaves by a ramp of its most load: nobody's force jumps, neither on the way nor where
/// `stands` changes.
TEST(ForceDistribution, RampsOfLoadGiveForcesWithoutJumps) {
  ForceDistribution distribution(kFriction);
  const BodyWrench wanted{{15.0, 10.0, kWeight_N}, {6.0, -4.0, 3.0}};
  std::vector<FootLoad> feet = four_feet();
  for (FootLoad& foot : feet) foot.least_N = 0.0;
  constexpr double kStep_N = 0.5;
  feet[1].stands = false;
  auto last = distribution.solve(wanted, feet).ground_on_foot_N;
  feet[1].stands = true;
  double largest_N = 0.0;
  for (int step = 0; step <= 500; ++step) {
    feet[1].most_N = kStep_N * step;
    const auto now = distribution.solve(wanted, feet).ground_on_foot_N;
    for (int i = 0; i < 4; ++i) largest_N = std::max(largest_N, (now[i] - last[i]).norm());
    last = now;
  }
  EXPECT_LE(largest_N, 1.5 * kStep_N);
  EXPECT_GT(last[1].z(), 50.0);
}

TEST(ForceDistribution, SameQuestionSameBitsWithoutHeap) {
  ForceDistribution used(kFriction);
  std::mt19937 random(4);
  for (int trial = 0; trial < 200; ++trial) {
    const std::vector<FootLoad> feet = random_feet(random);
    const BodyWrench wanted = random_wrench(random);
    ForceDistribution fresh(kFriction);
    const std::int64_t before = test::allocation_count();
    used.solve(wanted, feet);
    const DistributedForce& again = used.solve(wanted, feet);
    const DistributedForce& first = fresh.solve(wanted, feet);
    ASSERT_EQ(test::allocation_count(), before);
    ASSERT_EQ(again.ground_on_foot_N, first.ground_on_foot_N);
  }
}

}  // namespace
}  // namespace sprung
