#include "tools/lab/estimation/walking_estimate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <stdexcept>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

ContactStep step(std::optional<double> delay_ms, bool false_alarm = false) {
  ContactStep out;
  out.approach_speed_m_s = 0.3;
  out.delay_ms = delay_ms;
  out.false_alarm = false_alarm;
  return out;
}

void add_sample(TorqueScore& score, double error_Nm, double bound_Nm) {
  EstimatedJoint estimated;
  estimated.status = JointStatus::kOk;
  estimated.gear_output_torque_Nm = error_Nm;
  estimated.gear_output_torque_bound_Nm = bound_Nm;
  TrueJoint truth;
  truth.true_gear_output_torque_Nm = 0.0;
  score.add(estimated, truth);
}

const ReportRow& row(const std::vector<ReportRow>& rows, const std::string& name) {
  for (const ReportRow& r : rows) {
    if (r.name == "estimator." + name) return r;
  }
  throw std::invalid_argument(name);
}

TEST(WalkingEstimateRows, OfContactAreByTheGaitsName) {
  WalkingEstimate found;
  found.steps.assign(19, step(6.0));
  found.steps.push_back(step(40.0, true));
  found.steps.push_back(step(std::nullopt));
  const std::vector<ReportRow> rows = walking_estimate_rows("trot", found);
  EXPECT_NEAR(row(rows, "contact.trot.found").value, 100.0 * 20.0 / 21.0, 1e-9);
  EXPECT_FALSE(row(rows, "contact.trot.found").ok());
  EXPECT_DOUBLE_EQ(row(rows, "contact.trot.delay_median").value, 6.0);
  EXPECT_TRUE(row(rows, "contact.trot.delay_median").ok());
  EXPECT_DOUBLE_EQ(row(rows, "contact.trot.delay_p95").value, 40.0);
  EXPECT_FALSE(row(rows, "contact.trot.delay_p95").ok());
  EXPECT_NEAR(row(rows, "contact.trot.false_alarms").value, 100.0 / 21.0, 1e-9);
}

TEST(WalkingEstimateRows, OfTorqueTellStanceFromSwingAndPoolTheBounds) {
  WalkingEstimate found;
  add_sample(found.stance, 3.0, 2.0);
  add_sample(found.stance, -3.0, 4.0);
  WalkingEstimate other;
  add_sample(other.swing, 1.0, 2.0);
  add_sample(other.swing, 1.0, 2.0);
  other.fits = false;
  found.add(other);
  const std::vector<ReportRow> rows = walking_estimate_rows("crawl", found);
  EXPECT_DOUBLE_EQ(row(rows, "walk.crawl.stance_rms").value, 3.0);
  EXPECT_DOUBLE_EQ(row(rows, "walk.crawl.swing_rms").value, 1.0);
  EXPECT_DOUBLE_EQ(row(rows, "walk.crawl.coverage").value, 0.75);
  EXPECT_NEAR(row(rows, "walk.crawl.half_width_over_rms").value, 2.5 / std::sqrt(5.0), 1e-12);
  EXPECT_EQ(row(rows, "walk.crawl.model_fits").value, 0.0);
}

TEST(WalkingEstimateTest, EveryLegStepsAndEveryJointIsScored) {
  const RobotConfig robot = load_robot("pegasus");
  const WalkingEstimate found = walking_estimate(robot, {"best", "trot", 0.2, 2.0, {}});
  EXPECT_GT(found.steps.size(), 4u);
  const auto cycles = static_cast<std::int64_t>(2.0 / robot.cycle_s);
  EXPECT_GT(found.swing.samples(), 0);
  EXPECT_LE(found.stance.samples() + found.swing.samples(), 12 * cycles);
  EXPECT_GT(found.stance.samples() + found.swing.samples(), 11 * cycles);
}

TEST(WalkingEstimateTest, GaitThatThereIsNotIsRefused) {
  const WalkingEstimateRequest request{"best", "gallop", 0.3, 1.0, {}};
  EXPECT_THROW((void)walking_estimate(load_robot("pegasus"), request), std::invalid_argument);
}

}  // namespace
}  // namespace sprung
