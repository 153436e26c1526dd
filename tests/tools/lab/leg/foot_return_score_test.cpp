#include "tools/lab/leg/foot_return_score.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sprung {
namespace {

constexpr double kDirection_rad = 0.6;

/// Held 40 mm out along the pull, then on its way to `back_m` with the time constant `tau_s`; swings by
/// `swing_m`.
PullTrace trace(PlanePoint back_m, double tau_s, double swing_m = 0.0, double swing_Nm = 0.0) {
  PullTrace out;
  for (int k = -1200; k < 2500; ++k) {
    const double t = 1e-3 * k;
    const double share = t < -1.0 ? 0.0 : t < 0.0 ? 1.0 : std::exp(-t / tau_s);
    const double swing = t > 0.0 ? std::sin(30.0 * t) : 0.0;
    const PlanePoint out_m{0.04 * std::cos(kDirection_rad), 0.04 * std::sin(kDirection_rad)};
    const PlanePoint home_m = t < 0.0 ? PlanePoint{} : back_m;
    out.time_s.push_back(t);
    out.foot_m.push_back({home_m.x_m + share * (out_m.x_m - home_m.x_m) + 0.5 * swing_m * swing,
                          home_m.z_m + share * (out_m.z_m - home_m.z_m)});
    out.commanded_Nm.push_back({0.0, 5.0 + 0.5 * swing_Nm * swing});
  }
  return out;
}

TEST(FootReturnScoreTest, SeesHowFarAPullWentWhereTheFootStopsAndWhen) {
  const PullResult r = pull_result({kDirection_rad, 100.0}, trace({0.003, -0.004}, 0.1));
  EXPECT_NEAR(r.moved_mm, 40.0, 1e-6);
  EXPECT_NEAR(r.error_mm, 5.0, 1e-3);
  const double way_mm = 1e3 * std::hypot(0.04 * std::cos(kDirection_rad) - 0.003,
                                         0.04 * std::sin(kDirection_rad) + 0.004);
  EXPECT_NEAR(r.settled_s, 0.1 * std::log(way_mm / PullResult::kSettled_mm), 2e-3);
  EXPECT_FALSE(r.limit_cycle());
}

TEST(FootReturnScoreTest, FootOrTorqueThatStillSwingsIsALimitCycle) {
  EXPECT_FALSE(pull_result({kDirection_rad, 100.0}, trace({}, 0.1, 0.00015, 0.9)).limit_cycle());
  const PullResult foot = pull_result({kDirection_rad, 100.0}, trace({}, 0.1, 0.0003));
  EXPECT_TRUE(foot.limit_cycle());
  EXPECT_NEAR(foot.swing_mm, 0.3, 0.01);
  const PullResult torque = pull_result({kDirection_rad, 100.0}, trace({}, 0.1, 0.0, 1.1));
  EXPECT_TRUE(torque.limit_cycle());
  EXPECT_NEAR(torque.swing_Nm, 1.1, 0.01);
}

TEST(FootReturnScoreTest, StiffnessIsTheSlopeBetweenForcesSoThatEvenFrictionCancels) {
  std::vector<PullResult> pulls;
  for (const double force_N : {100.0, 120.0, 150.0}) {
    PullResult r;
    r.pull = {kDirection_rad, force_N};
    const double way_m = (force_N - 30.0) / 2000.0;
    r.held_m = {way_m * std::cos(kDirection_rad), way_m * std::sin(kDirection_rad)};
    pulls.push_back(r);
  }
  EXPECT_NEAR(measured_stiffness_N_m(pulls, kDirection_rad), 2000.0, 1e-6);
  EXPECT_TRUE(std::isnan(measured_stiffness_N_m(pulls, 0.0)));
}

TEST(FootReturnScoreTest, SummaryHasMeanWorstAndLeast) {
  std::vector<PullResult> pulls(3);
  for (std::size_t i = 0; i < 3; ++i) {
    pulls[i].error_mm = 1.0 + static_cast<double>(i);
    pulls[i].moved_mm = 50.0 - static_cast<double>(i);
    pulls[i].settled_s = 0.1 * static_cast<double>(i);
  }
  pulls[1].swing_Nm = 2.0;
  const FootReturnSummary s = summarize(pulls);
  EXPECT_DOUBLE_EQ(s.mean_mm, 2.0);
  EXPECT_DOUBLE_EQ(s.max_mm, 3.0);
  EXPECT_DOUBLE_EQ(s.min_mm, 1.0);
  EXPECT_DOUBLE_EQ(s.moved_least_mm, 48.0);
  EXPECT_DOUBLE_EQ(s.settled_worst_s, 0.2);
  EXPECT_EQ(s.limit_cycles, 1);
}

TEST(FootReturnScorerTest, SamplesFallToTheirPullAndTheWayHomeToNone) {
  FootReturnScript script;
  script.pulls = {{0.0, 100.0}, {1.0, 120.0}};
  FootReturnScorer scorer(script);
  using namespace foot_return;
  for (int k = 0; k < static_cast<int>(std::lround((kFirst_s + 2 * kPeriod_s) * 1e3)); ++k)
    scorer.add(1e-3 * k, {0.001 * k, 0.0}, {});
  ASSERT_EQ(scorer.traces().size(), 2u);
  for (const PullTrace& t : scorer.traces()) {
    EXPECT_NEAR(t.time_s.front(), kCentre_s - kRelease_s, 1.5e-3);
    EXPECT_NEAR(t.time_s.back(), kWatch_s, 1.5e-3);
  }
}

}  // namespace
}  // namespace sprung
