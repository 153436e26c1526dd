#include "tools/lab/gait/walk_experiment.h"

#include <gtest/gtest.h>

#include <cmath>

#include "robots/robot_loader.h"
#include "tools/lab/gait/ground_error.h"

namespace sprung {
namespace {

const ReportRow& walk_experiment_row(const std::vector<ReportRow>& rows, const std::string& name) {
  for (const ReportRow& row : rows)
    if (row.name == name) return row;
  throw std::out_of_range(name);
}

WalkExperiment walked() {
  WalkExperiment out;
  for (const auto& [control, rms_m] : {std::pair{WalkControl{GaitControl::kForce, false}, 0.030},
                                       {WalkControl{GaitControl::kHybrid}, 0.009},
                                       {WalkControl{GaitControl::kPreStance}, 0.012},
                                       {WalkControl{GaitControl::kForce}, 0.010}}) {
    out.controls.emplace_back();
    out.controls.back().control = control;
    out.controls.back().swing_rms_m = rms_m;
  }
  for (const GaitCase& config : gait_cases(load_robot("pegasus"))) {
    out.gaits.emplace_back();
    out.gaits.back().config = config;
    out.gaits.back().speed_m_s = 0.95 * config.speed_m_s;
    out.gaits.back().drift_rad = -0.05;
  }
  return out;
}

TEST(WalkRows, HybridSwingIsComparedWithForceControl) {
  WalkExperiment result = walked();
  EXPECT_NEAR(walk_experiment_row(walk_rows(result), "walk.hybrid.swing_ratio_plain").value, 0.3, 1e-12);
  EXPECT_TRUE(walk_experiment_row(walk_rows(result), "walk.hybrid.swing_ratio_plain").ok());
  EXPECT_NEAR(walk_experiment_row(walk_rows(result), "walk.hybrid.swing_ratio").value, 0.9, 1e-12);
  EXPECT_TRUE(walk_experiment_row(walk_rows(result), "walk.hybrid.swing_ratio").ok());
  EXPECT_NEAR(walk_experiment_row(walk_rows(result), "walk.prestance.swing_rms").value, 12.0, 1e-9);
  EXPECT_NEAR(walk_experiment_row(walk_rows(result), "walk.force_plain.swing_rms").value, 30.0, 1e-9);
  result.controls[1].swing_rms_m = 0.012;
  EXPECT_FALSE(walk_experiment_row(walk_rows(result), "walk.hybrid.swing_ratio").ok());
  EXPECT_FALSE(walk_experiment_row(walk_rows(result), "walk.hybrid.swing_ratio_plain").ok());
}

TEST(WalkRows, WhoFellOrWasTrippedHasNoSwingToCompare) {
  WalkExperiment result = walked();
  result.controls[1].vitals.fell = true;
  EXPECT_FALSE(walk_experiment_row(walk_rows(result), "walk.hybrid.swing_ratio").ok());
  result.controls[1].vitals = {};
  result.controls[1].vitals.trips = 1;
  EXPECT_FALSE(walk_experiment_row(walk_rows(result), "walk.hybrid.swing_ratio").ok());
}

TEST(WalkRows, SpeedMustBeWithinATenthAndHeadingWithinFiveDegreesToEitherSide) {
  WalkExperiment result = walked();
  EXPECT_TRUE(walk_experiment_row(walk_rows(result), "walk.crawl.speed").ok());
  EXPECT_NEAR(walk_experiment_row(walk_rows(result), "walk.trot.drift").value, 2.865, 1e-3);
  result.gaits[0].speed_m_s = 0.085;
  result.gaits[2].drift_rad = -0.1;
  EXPECT_FALSE(walk_experiment_row(walk_rows(result), "walk.crawl.speed").ok());
  EXPECT_FALSE(walk_experiment_row(walk_rows(result), "walk.trot.drift").ok());
}

TEST(WalkRows, TenPercentOfTheVoltageMustBeLeftWhereWindingsAreKnown) {
  WalkExperiment result = walked();
  result.gaits[0].reserve.least = 0.12;
  result.gaits[1].reserve.least = result.gaits[3].reserve.least = 0.08;
  EXPECT_TRUE(walk_experiment_row(walk_rows(result), "walk.crawl.voltage_reserve").ok());
  EXPECT_FALSE(walk_experiment_row(walk_rows(result), "walk.walk.voltage_reserve").ok());
  EXPECT_FALSE(walk_experiment_row(walk_rows(result), "walk.trot_stretch.voltage_reserve").ok());
  EXPECT_THROW(walk_experiment_row(walk_rows(result), "walk.trot.voltage_reserve"), std::out_of_range);
}

TEST(WalkRows, WhoFellOrWasTrippedHasNoSpeed) {
  WalkExperiment result = walked();
  result.gaits[2].vitals.fell = true;
  EXPECT_TRUE(std::isnan(walk_experiment_row(walk_rows(result), "walk.trot.speed").value));
  result.gaits[2].vitals = {};
  EXPECT_TRUE(walk_experiment_row(walk_rows(result), "walk.trot.speed").ok());
  result.gaits[2].vitals.trips = 1;
  EXPECT_FALSE(walk_experiment_row(walk_rows(result), "walk.trot.speed").ok());
}

TEST(WalkRows, EstimatedVelocityMustBeWithinFiveCentimetresASecond) {
  WalkExperiment result = walked();
  result.gaits[0].velocity_rms_m_s = 0.004;
  result.gaits[0].velocity_off = -0.02;
  result.gaits[2].velocity_rms_m_s = 0.051;
  EXPECT_TRUE(walk_experiment_row(walk_rows(result), "walk.crawl.velocity_rms").ok());
  EXPECT_NEAR(walk_experiment_row(walk_rows(result), "walk.crawl.velocity_off").value, -2.0, 1e-9);
  EXPECT_FALSE(walk_experiment_row(walk_rows(result), "walk.trot.velocity_rms").ok());
}

TEST(WalkCases, AreAtSharesOfTheRobotsOwnFastestSpeeds) {
  const auto speeds = [](const char* robot) {
    std::vector<double> out;
    for (const GaitCase& config : gait_cases(load_robot(robot))) out.push_back(config.speed_m_s);
    return out;
  };
  EXPECT_EQ(speeds("pegasus"), (std::vector<double>{0.1, 0.2, 0.35, 0.4}));
  EXPECT_EQ(speeds("fennec"), (std::vector<double>{0.075, 0.15, 0.265, 0.305}));
  EXPECT_THROW(gait_cases(load_robot("single_leg")), std::invalid_argument);
}

TEST(WalkRows, TorquesAreHeldAgainstTheRobotsOwnDrives) {
  WalkExperiment result = walked();
  result.limits.torque_Nm = 57.0;
  result.gaits[0].vitals.strongest_Nm = 57.1;
  EXPECT_EQ(walk_experiment_row(walk_rows(result), "walk.crawl.motor_torque_max").high, 57.0);
  EXPECT_FALSE(walk_experiment_row(walk_rows(result), "walk.crawl.motor_torque_max").ok());
}

TEST(WalkCases, LimitsAreThoseOfTheRobotsOwnDrives) {
  const WalkLimits pegasus = walk_limits(load_robot("pegasus")), fennec = walk_limits(load_robot("fennec"));
  EXPECT_NEAR(pegasus.torque_Nm, 0.8 * 108.0, 1e-9);
  EXPECT_EQ(pegasus.speed_rad_s, 4.36);
  EXPECT_EQ(pegasus.compared_m_s, 0.2);
  EXPECT_NEAR(fennec.torque_Nm, 0.8 * 50.0, 1e-9);
  EXPECT_EQ(fennec.speed_rad_s, 7.0);
  EXPECT_EQ(fennec.compared_m_s, 0.15);
}

/// The second quadruped: the planner refused pegasus's speeds.
TEST(Walk, AnotherRobotWalksInEveryGaitAtItsOwnSpeeds) {
  WalkTask task;
  task.distance_m = 0.05;
  const RobotConfig robot = load_robot("fennec");
  for (const GaitCase& config : gait_cases(robot)) {
    const GaitOutcome out = go(robot, task, config);
    EXPECT_FALSE(out.vitals.fell) << config.name << out.vitals.why;
    EXPECT_GE(out.distance_m, task.distance_m) << config.name;
  }
}

TEST(Walk, AStretchIsMeasuredFromWhenTheSpeedIsReached) {
  WalkTask task;
  task.distance_m = 0.3;
  const GaitOutcome out = go(load_robot("pegasus"), task, {"trot", "trot", 0.3, true});
  EXPECT_FALSE(out.vitals.fell) << out.vitals.why;
  EXPECT_GE(out.distance_m, 0.3);
  EXPECT_NEAR(out.speed_m_s, 0.3, 0.06);
  EXPECT_LT(out.velocity_rms_m_s, 0.02);
  EXPECT_GT(out.velocity_rms_m_s, 0.0005);  // it is an estimate
  EXPECT_LT(std::abs(out.velocity_off), 0.04);
}

TEST(Walk, ARefusedWalkIsNoResult) {
  WalkTask task;
  const RobotConfig robot = load_robot("pegasus");
  EXPECT_THROW(go(robot, task, {"trot", "trot", 9.0, true}), std::runtime_error);
  EXPECT_THROW(walk_uneven(robot, {}, {"crawl", 9.0, 0.01, true}, 1, 1.0), std::runtime_error);
}

GroundErrorResult stepped(double adaptive_N, double adaptive_Nm) {
  GroundErrorResult out;
  for (const GroundCase& config : ground_cases())
    for (const GaitControl control :
         {GaitControl::kHybrid, GaitControl::kPreStance, GaitControl::kAdaptive}) {
      out.touchdowns.emplace_back();
      out.touchdowns.back().name = config.name;
      out.touchdowns.back().control = control;
      const bool adaptive = control == GaitControl::kAdaptive;
      out.touchdowns.back().touchdowns = {
          {0, 0.0, 0.02, adaptive ? adaptive_N : 500.0, adaptive ? adaptive_Nm : 60.0}};
    }
  return out;
}

TEST(GroundErrorRows, OwnTouchdownsAreComparedWithPlainHybrid) {
  const auto good = ground_error_rows(stepped(250.0, 42.0));
  EXPECT_NEAR(walk_experiment_row(good, "ground_error.rig.force_ratio").value, 0.5, 1e-12);
  EXPECT_NEAR(walk_experiment_row(good, "ground_error.crawl.output_ratio").value, 0.7, 1e-12);
  EXPECT_TRUE(walk_experiment_row(good, "ground_error.rig.force_ratio").ok());
  const auto bad = ground_error_rows(stepped(310.0, 46.0));
  EXPECT_FALSE(walk_experiment_row(bad, "ground_error.rig.force_ratio").ok());
  EXPECT_FALSE(walk_experiment_row(bad, "ground_error.crawl.output_ratio").ok());
}

TEST(GroundErrorRows, WhoIsStoppedBySafetyCountsAsFallen) {
  GroundErrorResult result = stepped(250.0, 42.0);
  EXPECT_TRUE(walk_experiment_row(ground_error_rows(result), "ground_error.rig.adaptive_falls").ok());
  for (GroundOutcome& outcome : result.touchdowns)
    if (outcome.control == GaitControl::kAdaptive) outcome.vitals.trips = 1;
  EXPECT_FALSE(walk_experiment_row(ground_error_rows(result), "ground_error.rig.adaptive_falls").ok());
}

TEST(GroundErrorRows, NobodyMayFallInACrawlOnAnUnevenFloor) {
  GroundErrorResult result = stepped(250.0, 42.0);
  for (const UnevenCase& config : uneven_cases()) {
    result.uneven.push_back({config, std::vector<WalkVitals>(2), 0.0});
    result.uneven.back().runs[1].fell = true;
  }
  const auto rows = ground_error_rows(result);
  EXPECT_EQ(walk_experiment_row(rows, "ground_error.crawl_uneven_10.falls").value, 1.0);
  EXPECT_FALSE(walk_experiment_row(rows, "ground_error.crawl_uneven_20.falls").ok());
  EXPECT_TRUE(walk_experiment_row(rows, "ground_error.trot_uneven_20.falls").ok());
}

TEST(GroundError, TheGroundIsOfItsOwnNumberAndNotOfTheSeed) {
  const RobotConfig robot = load_robot("pegasus");
  const GroundCase rig{"rig", "crawl", 0.0, true, 5.0};
  const auto errors = [&](std::uint64_t seed, std::uint64_t ground) {
    GroundErrorTask task;
    task.sim.seed = seed;
    task.ground = ground;
    std::vector<int> out;
    for (const Touchdown& t : step_on_errors(robot, task, rig, GaitControl::kAdaptive).touchdowns)
      out.push_back(t.ground_error_m > 0.0 ? 1 : -1);
    return out;
  };
  EXPECT_EQ(errors(1, 3), errors(2, 3));
  EXPECT_NE(errors(1, 3), errors(1, 4));
}

TEST(GroundError, EveryTouchdownThatCountsIsOnGroundThatLiesWrong) {
  const GroundCase rig{"rig", "crawl", 0.0, true, 8.0};
  const GroundOutcome out = step_on_errors(load_robot("pegasus"), {}, rig, GaitControl::kAdaptive);
  EXPECT_FALSE(out.vitals.fell) << out.vitals.why;
  ASSERT_GE(out.touchdowns.size(), 4u);
  bool higher = false, lower = false;
  for (const Touchdown& t : out.touchdowns) {
    EXPECT_NEAR(std::abs(t.ground_error_m), 0.02, 1e-9);
    EXPECT_GT(t.force_N, 20.0);
    (t.ground_error_m > 0.0 ? higher : lower) = true;
  }
  EXPECT_TRUE(higher && lower);
}

}  // namespace
}  // namespace sprung
