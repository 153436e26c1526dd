#include "tools/lab/jump/jump_rows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sprung {
namespace {

const ReportRow* jump_rows_find(const std::vector<ReportRow>& rows, const std::string& name) {
  for (const ReportRow& row : rows) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

/// A jump that meets every figure that the paper gives for its mode.
JumpResult as_in_paper(JumpMode mode) {
  JumpResult jump;
  jump.positive_work_J = 70.0;
  jump.landing_knee_output_torque_Nm = 50.0;
  for (const JumpQuantity& quantity : jump_quantities()) {
    if (const auto paper = paper_jump_figure(mode, quantity.name)) jump.*quantity.value = *paper;
  }
  return jump;
}

std::vector<MeasuredJump> papers_jumps() {
  std::vector<MeasuredJump> jumps;
  for (const JumpMode mode : {JumpMode::kPosition, JumpMode::kTorque, JumpMode::kHybrid})
    jumps.push_back({"paper", mode, as_in_paper(mode), kNaN});
  return jumps;
}

TEST(JumpRows, PaperMeetsAllEighteenOfItsOwnFigures) {
  const PaperScore score = score_against_paper(papers_jumps());
  EXPECT_EQ(score.figures, 18);
  EXPECT_EQ(score.within, 18);
  EXPECT_TRUE(score.misses.empty());
}

TEST(JumpRows, FigureThatIsElevenPercentOffOrMissingIsAMiss) {
  std::vector<MeasuredJump> jumps = papers_jumps();
  jumps[0].result.landing_knee_torque_Nm *= 0.89;
  jumps[1].result.y_lag_ms = kNaN;
  jumps[2].result.height_mm *= 1.09;
  const PaperScore score = score_against_paper(jumps);
  EXPECT_EQ(score.within, 16);
  EXPECT_THAT(score.misses, testing::ElementsAre("position.landing_knee_torque", "torque.y_lag"));
}

TEST(JumpRows, VoltageReserveIsReportedWhereItIsKnown) {
  std::vector<MeasuredJump> jumps = papers_jumps();
  jumps[0].voltage_reserve = -0.25;
  const std::vector<ReportRow> rows = jump_rows(jumps, "paper");
  EXPECT_DOUBLE_EQ(jump_rows_find(rows, "jump.position.voltage_reserve")->value, -25.0);
  EXPECT_EQ(jump_rows_find(rows, "jump.torque.voltage_reserve"), nullptr);
}

TEST(JumpRows, DemandsOfPresetPaper) {
  std::vector<MeasuredJump> jumps = papers_jumps();
  std::vector<ReportRow> rows = jump_rows(jumps, "paper");
  EXPECT_DOUBLE_EQ(jump_rows_find(rows, "jump.ratio.hybrid_over_torque")->value, 9.46 / 24.21);
  EXPECT_DOUBLE_EQ(jump_rows_find(rows, "jump.ratio.hybrid_over_torque_output")->value, 1.0);
  EXPECT_TRUE(jump_rows_find(rows, "jump.ratio.hybrid_over_position")->ok());
  EXPECT_TRUE(jump_rows_find(rows, "jump.ratio.height_hybrid_over_position")->ok());
  EXPECT_TRUE(jump_rows_find(rows, "jump.ratio.work_hybrid_over_position")->ok());
  EXPECT_TRUE(jump_rows_find(rows, "jump.paper.within_10_percent")->ok());
  jumps[2].result.landing_knee_torque_Nm = 20.0;
  jumps[2].result.height_mm = 150.0;
  jumps[2].result.positive_work_J = 80.0;
  rows = jump_rows(jumps, "paper");
  for (const char* row :
       {"jump.hybrid.landing_knee_torque", "jump.ratio.hybrid_over_torque", "jump.ratio.hybrid_over_position",
        "jump.ratio.height_hybrid_over_position", "jump.ratio.work_hybrid_over_position"})
    EXPECT_FALSE(jump_rows_find(rows, row)->ok()) << row;
}

TEST(JumpRows, AdaptiveLandingIsComparedWithPositionControlOfItsOwnPreset) {
  std::vector<MeasuredJump> jumps = papers_jumps();
  jumps.push_back({"best", JumpMode::kPosition, as_in_paper(JumpMode::kPosition)});
  jumps.push_back({"best", JumpMode::kAdaptive, as_in_paper(JumpMode::kHybrid)});
  jumps[3].result.landing_knee_torque_Nm = 40.0;
  jumps[4].result.landing_knee_torque_Nm = 8.0;
  const std::vector<ReportRow> rows = jump_rows(jumps, "paper");
  const ReportRow* ratio = jump_rows_find(rows, "jump.ratio.adaptive_over_position");
  ASSERT_NE(ratio, nullptr);
  EXPECT_DOUBLE_EQ(ratio->value, 0.2);
  EXPECT_FALSE(ratio->high.has_value()) << "motors may pay for what the gears are spared";
  EXPECT_DOUBLE_EQ(jump_rows_find(rows, "jump.adaptive.landing_knee_torque")->value, 8.0);
  EXPECT_DOUBLE_EQ(jump_rows_find(rows, "jump.position.landing_knee_torque")->value, 61.58);
}

TEST(JumpRows, AdaptiveLandingMustSpareTheGearsOutputOfEitherJoint) {
  std::vector<MeasuredJump> jumps = {{"best", JumpMode::kPosition, {}}, {"best", JumpMode::kAdaptive, {}}};
  jumps[0].result.landing_knee_output_torque_Nm = 40.0;
  jumps[0].result.landing_hip_output_torque_Nm = 30.0;
  jumps[1].result.landing_knee_output_torque_Nm = 20.0;
  jumps[1].result.landing_hip_output_torque_Nm = 10.0;
  std::vector<ReportRow> rows = jump_rows(jumps, "best");
  EXPECT_DOUBLE_EQ(jump_rows_find(rows, "jump.ratio.adaptive_over_position_output")->value, 0.5);
  EXPECT_TRUE(jump_rows_find(rows, "jump.ratio.adaptive_over_position_output")->ok());
  EXPECT_TRUE(jump_rows_find(rows, "jump.ratio.adaptive_over_position_worst_output")->ok());
  jumps[1].result.landing_hip_output_torque_Nm = 28.0;
  rows = jump_rows(jumps, "best");
  EXPECT_DOUBLE_EQ(jump_rows_find(rows, "jump.ratio.adaptive_over_position_worst_output")->value, 0.7);
  EXPECT_FALSE(jump_rows_find(rows, "jump.ratio.adaptive_over_position_worst_output")->ok());
}

TEST(JumpRows, OtherPresetsAreNotHeldAgainstThePaper) {
  std::vector<MeasuredJump> jumps = papers_jumps();
  for (MeasuredJump& jump : jumps) jump.preset = "best";
  const std::vector<ReportRow> rows = jump_rows(jumps, "best");
  EXPECT_EQ(jump_rows_find(rows, "jump.paper.within_10_percent"), nullptr);
  EXPECT_FALSE(jump_rows_find(rows, "jump.ratio.hybrid_over_torque")->high.has_value());
  EXPECT_EQ(jump_rows_find(rows, "jump.hybrid.height")->low, 150.0);
}

}  // namespace
}  // namespace sprung
