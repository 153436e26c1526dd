/// Friction sweeps through the whole stack on the simulated robots, and what is made of them.
#include "tools/lab/friction/friction_sweep.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "robots/robot_loader.h"
#include "tools/lab/friction/friction_sweep_report.h"

namespace sprung {
namespace {

using ::testing::HasSubstr;

/// There and back at each speed under each load.
SweepPlan short_plan(const std::vector<double>& speeds_rad_s, const std::vector<double>& loads_Nm) {
  SweepPlan plan;
  plan.samples_a_pass = 40;
  plan.mirrored = true;
  for (const double load_Nm : loads_Nm) {
    for (const double speed_rad_s : speeds_rad_s) {
      const double half_rad = std::max(0.1, 0.6 * speed_rad_s);
      plan.passes.push_back({-half_rad, half_rad, speed_rad_s, 25.0, load_Nm, false});
      plan.passes.push_back({half_rad, -half_rad, speed_rad_s, 25.0, load_Nm, false});
    }
  }
  return plan;
}

SweepRecording on_test_axis(SweepProtocol protocol, const SweepPlan& plan, std::uint64_t seed) {
  SimOptions sim;
  sim.seed = seed;
  return record_sweep(load_robot("test_axis"), "best", sim, 0, protocol, plan);
}

double mean(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

TEST(FrictionSweep, BothDirectionsTogetherShowThePlantsFriction) {
  const SweepRecording recording = on_test_axis(SweepProtocol::kS0, short_plan({0.3, 1.5}, {0.0}), 1);
  ASSERT_EQ(recording.passes.size(), 4u);
  EXPECT_EQ(recording.joint, "arm");
  EXPECT_EQ(recording.gear_ratio, 100.0);
  for (std::size_t i = 0; i < 4; i += 2) {
    const RecordedPass& there = recording.passes[i];
    const RecordedPass& back = recording.passes[i + 1];
    EXPECT_NEAR(there.velocity_rad_s, there.pass.speed_rad_s, 0.03 * there.pass.speed_rad_s);
    EXPECT_NEAR(back.velocity_rad_s, -back.pass.speed_rad_s, 0.03 * back.pass.speed_rad_s);
    const double found_Nm = 0.5 * (mean(there.motor_torque_Nm) - mean(back.motor_torque_Nm));
    const double true_Nm = 0.5 * (std::abs(there.true_friction_Nm) + std::abs(back.true_friction_Nm));
    EXPECT_NEAR(found_Nm, true_Nm, 0.4) << there.pass.speed_rad_s;
  }
}

TEST(FrictionSweep, TheSensorCarriesWeightAndLoad) {
  const SweepRecording recording = on_test_axis(SweepProtocol::kLoaded, short_plan({0.5}, {15.0, -15.0}), 1);
  for (const RecordedPass& pass : recording.passes) {
    ASSERT_EQ(pass.sensed_torque_Nm.size(), pass.time_s.size());
    // Mirrored spans: the arm's weight is as often on one side as on the other.
    EXPECT_NEAR(mean(pass.sensed_torque_Nm), -pass.pass.load_Nm, 1.0);
  }
}

TEST(FrictionSweep, TheSameSeedGivesTheSameBitsAndAnotherNoiseOnly) {
  const SweepPlan plan = short_plan({1.0}, {0.0});
  const SweepRecording one = on_test_axis(SweepProtocol::kS1, plan, 5);
  const SweepRecording same = on_test_axis(SweepProtocol::kS1, plan, 5);
  const SweepRecording other = on_test_axis(SweepProtocol::kS1, plan, 6);
  EXPECT_EQ(one.passes[0].motor_torque_Nm, same.passes[0].motor_torque_Nm);
  EXPECT_NE(one.passes[0].motor_torque_Nm, other.passes[0].motor_torque_Nm);
  EXPECT_NEAR(mean(one.passes[0].motor_torque_Nm), mean(other.passes[0].motor_torque_Nm), 0.5);
}

TEST(FrictionSweep, AJointThatTurnsAboutAnotherAxisCannotBeLoadedSo) {
  const RobotConfig robot = load_robot("pegasus");
  const int abduction = bench_joint(robot, "fl_abduction");
  JointBench bench(robot, "best", {}, abduction);
  bench.home();
  bench.move(0.1, 0.5, 5.0);
  EXPECT_THROW(bench.find_load_sense(15.0), std::runtime_error);
}

TEST(FrictionSweep, ALoadIsPositiveTowardPlusOnEveryAxis) {
  const RobotConfig robot = load_robot("pegasus");
  for (const char* joint : {"fl_hip", "fl_knee"}) {
    JointBench bench(robot, "best", {}, bench_joint(robot, joint));
    bench.home();
    bench.move(bench.sample().position_rad - 0.1, 0.5, 5.0);
    bench.find_load_sense(15.0);
    const double before_rad = bench.truth().true_position_rad;
    bench.load(15.0);
    bench.run(0.5);
    EXPECT_GT(bench.truth().true_position_rad, before_rad + 0.005) << joint;
  }
}

TEST(FrictionSweep, JointsAreFoundByNameAndTheKneeByItself) {
  const RobotConfig robot = load_robot("pegasus");
  EXPECT_EQ(robot.joints[bench_joint(robot, "")].name, "fl_knee");
  EXPECT_EQ(robot.joints[bench_joint(robot, "hr_hip")].name, "hr_hip");
  EXPECT_THAT([&] { (void)bench_joint(robot, "elbow"); },
              testing::ThrowsMessage<std::invalid_argument>(HasSubstr("fl_knee")));
  EXPECT_EQ(bench_joint(load_robot("test_axis"), ""), 0);
}

/// Rows and report of a small recording: what is shown, not how good it is.
SweepResult small_result(SweepProtocol protocol, SweepPoints points, const std::vector<double>& loads_Nm) {
  SweepResult out;
  out.recording = on_test_axis(protocol, short_plan({0.2, 0.8, 1.6}, loads_Nm), 3);
  for (std::size_t i = 0; i < out.recording.passes.size(); ++i)
    out.recording.passes[i].pass.held_out = i / 2 % 2 == 1;
  out.points = points;
  for (const identification::JointTerms& terms : sweep_models(out.recording, points))
    out.fits.push_back(fit_sweep(out.recording, points, terms));
  return out;
}

const ReportRow* friction_sweep_find(const std::vector<ReportRow>& rows, const std::string& name) {
  const auto found = std::find_if(rows.begin(), rows.end(),
                                  [&](const ReportRow& row) { return row.name == name; });
  return found == rows.end() ? nullptr : &*found;
}

TEST(FrictionSweep, LoadedRowsCompareWithAndWithoutTheLoadTerm) {
  const SweepResult result = small_result(SweepProtocol::kLoaded, SweepPoints::kBoth, {-15.0, 0.0, 15.0});
  const std::vector<ReportRow> rows = sweep_rows(result, "x");
  ASSERT_NE(friction_sweep_find(rows, "x.r2"), nullptr);
  EXPECT_EQ(friction_sweep_find(rows, "x.r2")->low, 0.98);
  EXPECT_TRUE(friction_sweep_find(rows, "x.r2")->ok()) << friction_sweep_find(rows, "x.r2")->value;
  EXPECT_LT(friction_sweep_find(rows, "x.without_load_term_r2")->value,
            friction_sweep_find(rows, "x.r2")->value);
  EXPECT_GT(friction_sweep_find(rows, "x.load_share_driving")->value, 0.05);
  EXPECT_GT(friction_sweep_find(rows, "x.load_share_driving_standard_error")->value, 0.0);
}

TEST(FrictionSweep, BoundsOfS1HoldForItsOwnRatioOnly) {
  SweepResult result = small_result(SweepProtocol::kS1, SweepPoints::kForward, {0.0});
  EXPECT_FALSE(friction_sweep_find(sweep_rows(result, "x"), "x.r2")->low);
  result.recording.gear_ratio = 50.0;
  EXPECT_EQ(friction_sweep_find(sweep_rows(result, "x"), "x.r2")->paper, 0.9319);
  EXPECT_NEAR(*friction_sweep_find(sweep_rows(result, "x"), "x.r2")->low, 0.91, 1e-12);
}

TEST(FrictionSweep, TheReportNamesItsProtocolAndEveryModel) {
  const SweepResult result = small_result(SweepProtocol::kLoaded, SweepPoints::kBoth, {-15.0, 15.0});
  const std::string html = report::to_html({"title", "", "", {sweep_section(result)}});
  for (const char* text : {"Protocol loaded", "torque sensor", "viscous+stribeck+load+asymmetry", "coulomb",
                           "load_share_driven", "Residuals over load"})
    EXPECT_THAT(html, HasSubstr(text));
  EXPECT_THAT(sweep_table(result), HasSubstr("held out"));
}

}  // namespace
}  // namespace sprung
