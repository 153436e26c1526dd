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
  static constexpr double kSpring_N_m = 3000.0;
  explicit SpringFoot(double damper_N_s_m) : damper_N_s_m_(damper_N_s_m) {}
  void push(const PlanePoint& force_N) {
    at_m.x_m += kCycle_s * (force_N.x_m - kSpring_N_m * at_m.x_m) / damper_N_s_m_;
    at_m.z_m += kCycle_s * (force_N.z_m - kSpring_N_m * at_m.z_m) / damper_N_s_m_;
  }
  PlanePoint at_m;

 private:
  double damper_N_s_m_;
};

/// @return how far along, once the foot was held. Expects that nothing pulls beside, and that the hand's
/// force is what holds the foot.
double led_m(const HandGrip& grip, double damper_N_s_m, double direction_rad, double way_m) {
  FootDisturbance hand({direction_rad, way_m, 2.0}, grip, kCycle_s);
  SpringFoot foot(damper_N_s_m);
  for (double t = 0.0; t < FootDisturbance::kGone_s; t += kCycle_s) foot.push(hand.step_N(t, foot.at_m));
  const double c = std::cos(direction_rad), s = std::sin(direction_rad);
  const double along_m = foot.at_m.x_m * c + foot.at_m.z_m * s;
  EXPECT_NEAR(std::hypot(hand.held_N().x_m, hand.held_N().z_m), SpringFoot::kSpring_N_m * along_m, 3.0);
  EXPECT_NEAR(foot.at_m.x_m * s, foot.at_m.z_m * c, 1e-6);
  return along_m;
}

TEST(FootDisturbanceTest, FirmHandLeadsTheFootNearlyAsFarAsAskedAlongItsDirection) {
  EXPECT_NEAR(led_m(kFirmGrip, 2000.0, 2.0, 0.024),
              0.024 / (1.0 + SpringFoot::kSpring_N_m / kFirmGrip.stiffness_N_m), 5e-4);
}

TEST(FootDisturbanceTest, SoftHandLeadsItAsFarAndNotBeyond) {
  EXPECT_NEAR(led_m(kSoftGrip, 400.0, 2.0, 0.024), 0.024, 1.5e-3);
}

TEST(FootDisturbanceTest, ForceFadesInAStraightLineFromWhatHeldTheFootAndIsGoneAtTheEnd) {
  FootDisturbance hand({0.0, 0.016, 2.0}, kFirmGrip, kCycle_s);
  const double held_N = hand.step_N(FootDisturbance::kGone_s - 1e-9, {}).x_m;
  EXPECT_GT(held_N, 100.0);
  EXPECT_NEAR(hand.step_N(FootDisturbance::kGone_s + 0.5, {}).x_m, 0.75 * held_N, 1e-9);
  EXPECT_NEAR(hand.step_N(FootDisturbance::kGone_s + 1.5, {0.01, 0.0}).x_m, 0.25 * held_N, 1e-9);
  EXPECT_EQ(hand.step_N(hand.length_s(), {}).x_m, 0.0);
  EXPECT_EQ(hand.length_s(), FootDisturbance::kGone_s + 2.0);
}

}  // namespace
}  // namespace sprung
