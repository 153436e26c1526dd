#include "tools/lab/gait/fall_experiment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "robots/robot_loader.h"
#include "tools/lab/gait/legged_trial.h"

namespace sprung {
namespace {

FallOutcome thrown(double trunk_N, double gear_Nm, bool noticed = true) {
  FallOutcome out;
  out.vitals.fell = true;
  out.vitals.caught = noticed;
  out.trunk_peak_N = trunk_N;
  out.gear_peak_Nm = gear_Nm;
  return out;
}

const ReportRow& fall_row(const std::vector<ReportRow>& rows, const std::string& name) {
  for (const ReportRow& row : rows)
    if (row.name == "fall." + name) return row;
  ADD_FAILURE() << name;
  return rows.front();
}

TEST(FallExperiment, RatioIsOfTheMeansOfThosePairsInWhichBothFell) {
  const std::vector<ReportRow> rows = fall_rows({{{}, thrown(1000.0, 200.0), thrown(3000.0, 100.0)},
                                                 {{}, thrown(2000.0, 100.0), thrown(1000.0, 100.0)},
                                                 {{}, FallOutcome{}, thrown(9000.0, 100.0)}});
  EXPECT_NEAR(fall_row(rows, "trunk_peak.ratio").value, 0.75, 1e-12);
  EXPECT_FALSE(fall_row(rows, "trunk_peak.ratio").ok());
  EXPECT_TRUE(fall_row(fall_rows({}, false), "trunk_peak.ratio").ok())
      << "nobody can meet what none foresees";
  EXPECT_NEAR(fall_row(rows, "trunk_peak.met").value, 1500.0, 1e-9);
  EXPECT_NEAR(fall_row(rows, "trunk_peak.worst").value, 2000.0, 1e-9);
  EXPECT_NEAR(fall_row(rows, "gear_peak.met").value, 150.0, 1e-9);
  EXPECT_EQ(fall_row(rows, "pairs").value, 2.0);
  EXPECT_EQ(fall_row(rows, "stayed_up").value, 1.0);
}

TEST(FallExperiment, FallThatNobodyNoticedIsNotOk) {
  const std::vector<ReportRow> rows = fall_rows({{{}, thrown(10.0, 1.0, false), thrown(100.0, 1.0)}});
  EXPECT_EQ(fall_row(rows, "unnoticed").value, 1.0);
  EXPECT_FALSE(fall_row(rows, "unnoticed").ok());
}

TEST(FallExperiment, WithoutAFallThereIsNoRatio) {
  const std::vector<ReportRow> rows = fall_rows({{{}, FallOutcome{}, FallOutcome{}}});
  EXPECT_TRUE(std::isnan(fall_row(rows, "trunk_peak.ratio").value));
  EXPECT_FALSE(fall_row(rows, "trunk_peak.ratio").ok());
}

TEST(FallExperiment, EveryGaitIsPushedToEverySideByItsMassEachOnAnotherDraw) {
  const RobotConfig robot = load_robot("pegasus");
  const std::vector<FallCase> cases = fall_cases(robot, 7.0);
  ASSERT_EQ(cases.size(), robot.gaits.size() * 2 * 4);
  EXPECT_NEAR(cases.front().impulse_Ns, 60.0, 1e-9);
  std::set<double> draws;
  for (const FallCase& one : cases) draws.insert(one.draw);
  EXPECT_EQ(draws.size(), cases.size());
  EXPECT_EQ(*draws.begin(), 7.0);
}

TEST(FallExperiment, LegsThatMeetAFallSpareTheTrunk) {
  RobotConfig robot = load_robot("pegasus");
  FallCase push;
  push.gait = "stand";
  push.impulse_Ns = 60.0;
  push.direction = PushDirection::kLeft;
  const FallOutcome met = fall_once(robot, "", SimOptions{1, {}}, push);
  robot.body.meets_falls = false;
  const FallOutcome damped = fall_once(robot, "", SimOptions{1, {}}, push);
  EXPECT_TRUE(met.vitals.caught);
  EXPECT_TRUE(damped.vitals.caught);
  EXPECT_GT(damped.trunk_peak_N, 1000.0);
  EXPECT_LT(met.trunk_peak_N, 0.8 * damped.trunk_peak_N);
}

}  // namespace
}  // namespace sprung
