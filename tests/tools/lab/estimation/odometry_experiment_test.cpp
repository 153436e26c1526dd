#include "tools/lab/estimation/odometry_experiment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <vector>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

ExperimentOutput eight(std::vector<const char*> words) {
  Experiment experiment = odometry_experiment();
  CommandLine line("odometry", "");
  experiment.own.add_to(line);
  line.action([] { return 0; });
  words.insert(words.begin(), "odometry");
  EXPECT_EQ(line.run(static_cast<int>(words.size()), words.data()), 0);
  ExperimentRequest request;
  request.robot = "pegasus";
  return experiment.run(experiment_input(experiment, request, load_robot("pegasus")));
}

TEST(OdometryExperiment, AGaitsEightHasARowForEachErrorAndIsWithinItsBounds) {
  std::map<std::string, ReportRow> rows;
  for (const ReportRow& row : eight({"--gait", "trot", "--distance", "3"}).rows) rows[row.name] = row;
  EXPECT_EQ(rows.size(), 10u);
  EXPECT_NEAR(rows["odometry.trot.way"].value, 3.0, 0.7);
  EXPECT_TRUE(std::isnan(rows["odometry.trot.tilt_when_turned"].value)) << "it turned by too little";
  for (const char* bounded : {"position_error", "velocity_worst", "position_nees", "velocity_nees"}) {
    const ReportRow& row = rows[std::string("odometry.trot.") + bounded];
    EXPECT_TRUE(row.ok()) << bounded << " " << row.value;
    EXPECT_GT(row.value, 0.0) << bounded;
  }
}

TEST(OdometryExperiment, WhoTurnsHasItsTiltJudged) {
  std::map<std::string, ReportRow> rows;
  for (const ReportRow& row : eight({"--gait", "trot", "--distance", "12"}).rows) rows[row.name] = row;
  EXPECT_GT(rows["odometry.trot.tilt_when_turned"].value, 0.0);
  EXPECT_LT(rows["odometry.trot.tilt_when_turned"].value, 1.0);
}

TEST(OdometryExperiment, WrongWordsAreRefused) {
  EXPECT_THROW(eight({"--gait", "amble"}), std::invalid_argument);
  EXPECT_THROW(eight({"--gait", "stand"}), std::invalid_argument);
  EXPECT_THROW(eight({"--distance", "0"}), std::invalid_argument);
}

}  // namespace
}  // namespace sprung
