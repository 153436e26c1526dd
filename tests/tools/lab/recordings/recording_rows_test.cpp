#include "tools/lab/recordings/recording_rows.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace sprung::recordings {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

RecordingResult joint(const std::string& name, double chosen_r2) {
  return {name,
          "A",
          {{"coulomb", 5, 0.93, 0.7, kNone, false},
           {"viscous+stribeck", 8, 0.992, 0.2, kNone, false},
           {"viscous+load", 8, chosen_r2, 0.1, kNone, true}},
          "because"};
}

ReportRow recording_rows_row(const std::vector<ReportRow>& rows, const std::string& name) {
  for (const ReportRow& found : rows) {
    if (found.name == name) return found;
  }
  throw std::out_of_range(name);
}

TEST(RecordingRows, OneOfTheToolsChoiceAndThoseOfSimpleModelsBesideIt) {
  const auto rows = rows_of(joint("ur10e joint 1", 0.9965));
  EXPECT_EQ(recording_rows_row(rows, "estimator.ur10e_joint_1.r2").value, 0.9965);
  EXPECT_EQ(recording_rows_row(rows, "estimator.ur10e_joint_1.r2").low, 0.9940);
  EXPECT_EQ(recording_rows_row(rows, "estimator.ur10e_joint_1.parameters").value, 8.0);
  EXPECT_EQ(recording_rows_row(rows, "estimator.ur10e_joint_1.parameters").high, 14.0);
  EXPECT_EQ(recording_rows_row(rows, "estimator.ur10e_joint_1.coulomb").value, 0.93);
  EXPECT_EQ(recording_rows_row(rows, "estimator.ur10e_joint_1.stribeck").value, 0.992);
  EXPECT_EQ(recording_rows_row(rows, "estimator.ur10e_joint_1.model_viscous_load").value, 0.9965);
}

TEST(RecordingRows, JointsThatNobodyKnowsAreReportedAndHeldAgainstStribeck) {
  const auto rows = rows_of(joint("ur10e joint 4", 0.9910));
  EXPECT_FALSE(recording_rows_row(rows, "estimator.ur10e_joint_4.r2").low.has_value());
  const ReportRow ahead = recording_rows_row(rows, "estimator.ur10e_joint_4.ahead_of_stribeck");
  EXPECT_NEAR(ahead.value, -0.001, 1e-12);
  EXPECT_EQ(ahead.low, -0.0005);
}

TEST(RecordingRows, WhereTheLoadIsKnownTheLinksTorqueIsScored) {
  RecordingResult result = joint("lara8 joint 3", 0.998);
  for (ModelScore& model : result.models) model.link_rms_Nm = model.chosen ? 3.4 : 7.1;
  const auto rows = rows_of(result);
  EXPECT_EQ(recording_rows_row(rows, "estimator.lara8_joint_3.rms").value, 3.4);
  EXPECT_EQ(recording_rows_row(rows, "estimator.lara8_joint_3.rms").unit, "Nm");
  EXPECT_EQ(recording_rows_row(rows, "estimator.lara8_joint_3.rms").high, 3.6);
  EXPECT_EQ(recording_rows_row(rows, "estimator.lara8_joint_3.parameters").high, 8.0);
  EXPECT_EQ(recording_rows_row(rows, "estimator.lara8_joint_3.stribeck").value, 7.1);
}

TEST(RecordingRows, PredictionBoundsShallHoldWhatTheyPromise) {
  RecordingResult result = joint("ur10e joint 1", 0.9965);
  result.models.back().prediction_bound = 0.3;
  result.models.back().covered = 0.95;
  const auto covered = [&] {
    return recording_rows_row(rows_of(result), "estimator.ur10e_joint_1.prediction_covered");
  };
  EXPECT_EQ(covered().value, 95.0);
  EXPECT_TRUE(covered().ok());
  result.models.back().covered = 0.98;
  EXPECT_FALSE(covered().ok()) << "wider than they need be";
  EXPECT_EQ(recording_rows_row(rows_of(result), "estimator.ur10e_joint_1.prediction_bound").unit, "A");
}

TEST(RecordingRows, FootprintWithAndWithout) {
  const auto rows = rows_of(FootprintScore{42.0, 6.0});
  EXPECT_EQ(recording_rows_row(rows, "estimator.lara8_footprint.without").value, 42.0);
  EXPECT_EQ(recording_rows_row(rows, "estimator.lara8_footprint.with").value, 6.0);
}

TEST(RecordingRows, AFolderWithoutRecordingsGivesNone) { EXPECT_TRUE(results_of("/nowhere").empty()); }

}  // namespace
}  // namespace sprung::recordings
