#include "tools/lab/gait/parameter_experiment.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

TEST(ParameterExperiment, SoftSpringsAndALowRobotNeitherFallNorKick) {
  const RobotConfig robot = load_robot("pegasus");
  SimOptions sim;
  sim.seed = 3;
  const auto trials = run_parameter_trials(robot, "best", sim, {"walk.stance.stiffness.z", "stand_length"});
  ASSERT_EQ(trials.size(), 12u);
  for (const ParameterTrial& trial : trials) {
    SCOPED_TRACE(std::string(name(trial.motion)) + " " + trial.name);
    EXPECT_FALSE(trial.fell);
    EXPECT_EQ(trial.trips, 0);
    EXPECT_LE(trial.worst_step, 0.05);
    EXPECT_EQ(trial.refused, trial.motion == ParameterMotion::kComply && trial.name == "stand_length");
  }
  const bool acts = std::any_of(trials.begin(), trials.end(), [](const ParameterTrial& trial) {
    return trial.motion == ParameterMotion::kStand && trial.worst_step > 0.0;
  });
  EXPECT_TRUE(acts) << "what is set shows in the torques";
}

TEST(ParameterExperiment, RowsCountWhatWentWrong) {
  ParameterTrial bad;
  bad.motion = ParameterMotion::kTrot;
  bad.fell = true;
  bad.worst_step = 0.2;
  ParameterTrial good;
  good.motion = ParameterMotion::kTrot;
  const auto rows = parameter_rows({bad, good});
  const auto value = [&](const std::string& name) {
    return std::find_if(rows.begin(), rows.end(), [&](const ReportRow& r) { return r.name == name; })->value;
  };
  EXPECT_EQ(value("parameters.trot.falls"), 1.0);
  EXPECT_EQ(value("parameters.trot.runs"), 2.0);
  EXPECT_EQ(value("parameters.trot.worst_step"), 20.0);
  EXPECT_EQ(value("parameters.stand.runs"), 0.0);
}

}  // namespace
}  // namespace sprung
