#include "tools/lab/leg/foot_disturbance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

namespace sprung {
namespace {

constexpr double kCycle_s = 0.002;

TEST(FootDisturbanceTest, EightDirectionsOfFiveWaysWithEveryReleaseAsOftenAsEveryWay) {
  std::set<double> directions;
  std::map<double, std::set<double>> releases_of_way;
  for (const PullAndRelease& pull : pulls_and_releases()) {
    directions.insert(pull.direction_rad);
    releases_of_way[pull.distance_m].insert(pull.release_s);
    EXPECT_GE(pull.release_s, 1.0);
    EXPECT_LE(pull.release_s, 3.0);
  }
  EXPECT_EQ(pulls_and_releases().size(), 40u);
  EXPECT_EQ(directions.size(), 8u);
  ASSERT_EQ(releases_of_way.size(), 5u);
  EXPECT_NEAR(releases_of_way.begin()->first, 0.008, 1e-12);
  EXPECT_NEAR(releases_of_way.rbegin()->first, 0.040, 1e-12);
  for (const auto& [way, releases] : releases_of_way) EXPECT_EQ(releases.size(), 5u) << way;
}

/// A foot on a damped spring without mass: what a hand can lead.
class SpringFoot {
 public:
  static constexpr double kSpring_N_m = 3000.0, kDamper_N_s_m = 2000.0;
  void push(const PlanePoint& force_N) {
    at_m.x_m += kCycle_s * (force_N.x_m - kSpring_N_m * at_m.x_m) / kDamper_N_s_m;
    at_m.z_m += kCycle_s * (force_N.z_m - kSpring_N_m * at_m.z_m) / kDamper_N_s_m;
  }
  PlanePoint at_m;
};

TEST(FootDisturbanceTest, LeadsTheFootNearlyAsFarAsAskedAlongItsDirectionAndHoldsItWithTheSpringsForce) {
  const PullAndRelease pull{2.0, 0.024, 2.0};
  FootDisturbance hand(pull, kCycle_s);
  SpringFoot foot;
  for (double t = 0.0; t < FootDisturbance::kGone_s; t += kCycle_s) foot.push(hand.step_N(t, foot.at_m));
  const double way_m = foot.at_m.x_m * std::cos(2.0) + foot.at_m.z_m * std::sin(2.0);
  EXPECT_NEAR(way_m, 0.024 / (1.0 + SpringFoot::kSpring_N_m / FootDisturbance::kStiffness_N_m), 5e-4);
  EXPECT_NEAR(std::hypot(hand.held_N().x_m, hand.held_N().z_m), SpringFoot::kSpring_N_m * way_m, 3.0);
  EXPECT_NEAR(foot.at_m.x_m * std::sin(2.0), foot.at_m.z_m * std::cos(2.0), 1e-6);
}

TEST(FootDisturbanceTest, ForceFadesInAStraightLineFromWhatHeldTheFootAndIsGoneAtTheEnd) {
  FootDisturbance hand({0.0, 0.016, 2.0}, kCycle_s);
  const double held_N = hand.step_N(FootDisturbance::kGone_s - 1e-9, {}).x_m;
  EXPECT_GT(held_N, 100.0);
  EXPECT_NEAR(hand.step_N(FootDisturbance::kGone_s + 0.5, {}).x_m, 0.75 * held_N, 1e-9);
  EXPECT_NEAR(hand.step_N(FootDisturbance::kGone_s + 1.5, {0.01, 0.0}).x_m, 0.25 * held_N, 1e-9);
  EXPECT_EQ(hand.step_N(hand.length_s(), {}).x_m, 0.0);
  EXPECT_EQ(hand.length_s(), FootDisturbance::kGone_s + 2.0);
}

}  // namespace
}  // namespace sprung
