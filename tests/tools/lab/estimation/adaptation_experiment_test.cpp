#include "tools/lab/estimation/adaptation_experiment.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

double adaptation_value(const std::vector<ReportRow>& rows, const std::string& name) {
  const auto found = std::find_if(rows.begin(), rows.end(),
                                  [&](const ReportRow& row) { return row.name == name; });
  return found == rows.end() ? kNaN : found->value;
}

TEST(AdaptationExperimentTest, AHungLegFindsThatItsGearsHaveLessFriction) {
  AdaptationTask task;
  task.preset = "best";
  task.sim.seed = 3;
  task.sim.plant["friction_scale"] = 0.8;
  task.motion_s = 45.0;
  const RobotConfig robot = load_robot("single_leg");
  const AdaptationOutcome off = run_adaptation(robot, task, false);
  const AdaptationOutcome on = run_adaptation(robot, task, true);
  EXPECT_EQ(off.least_dry, 1.0);
  EXPECT_EQ(off.most_viscous, 1.0);
  EXPECT_LT(on.least_dry, 0.9);
  EXPECT_LT(on.torque.rms_Nm(), 0.9 * off.torque.rms_Nm());
  const std::vector<ReportRow> rows = adaptation_rows(off, on);
  EXPECT_LT(adaptation_value(rows, "adaptation.rms_ratio"), 0.9);
  EXPECT_NEAR(adaptation_value(rows, "adaptation.on.rms"), on.torque.rms_Nm(), 1e-12);
}

TEST(AdaptationExperimentTest, ARobotWithGaitsTrots) {
  AdaptationTask task;
  task.preset = "best";
  task.motion_s = 3.0;
  const AdaptationOutcome on = run_adaptation(load_robot("pegasus"), task, true);
  EXPECT_GT(on.torque.samples(), 1000);
  EXPECT_TRUE(on.fits);
  EXPECT_LT(on.torque.rms_Nm(), 4.0);
}

}  // namespace
}  // namespace sprung
