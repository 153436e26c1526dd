#include "tools/lab/jump/jump_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

using testing::HasSubstr;

/// One run in the papers' three modes and the own one, for all tests.
class JumpReportTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    robot_ = new RobotConfig(load_robot("single_leg"));
    experiment_ = new JumpExperiment(run_jump_experiment(*robot_, "paper", {}, run_in_process));
  }
  static void TearDownTestSuite() {
    delete experiment_;
    delete robot_;
  }
  static RobotConfig* robot_;
  static JumpExperiment* experiment_;
};

RobotConfig* JumpReportTest::robot_ = nullptr;
JumpExperiment* JumpReportTest::experiment_ = nullptr;

TEST_F(JumpReportTest, HasASummaryAFigureForEachModeAndTheParameters) {
  SimOptions sim;
  sim.plant["friction_scale"] = 1.1;
  const std::vector<report::Section> sections = jump_sections(*robot_, sim, *experiment_);
  ASSERT_EQ(sections.size(), 6u);
  EXPECT_EQ(sections[0].heading, "Summary");
  EXPECT_THAT(sections[1].heading, HasSubstr("Fig. 10"));
  EXPECT_THAT(sections[2].heading, HasSubstr("Fig. 11"));
  EXPECT_THAT(sections[3].heading, HasSubstr("Fig. 12"));
  EXPECT_THAT(sections[4].heading, HasSubstr("adaptive landing"));
  EXPECT_EQ(sections[5].tables.back().rows[0][0].text, "friction_scale");
}

TEST_F(JumpReportTest, EveryRowOfTheExperimentIsInTheTableWithItsRatio) {
  const report::Section summary = jump_sections(*robot_, {}, *experiment_)[0];
  const report::Table& table = summary.tables[0];
  ASSERT_EQ(table.rows.size(), experiment_->rows.size());
  EXPECT_EQ(table.rows[0][0].text, "jump.position.height");
  EXPECT_EQ(table.rows[0][2].text, "184");
  EXPECT_FALSE(table.rows[0][4].text.empty());
}

TEST_F(JumpReportTest, PlotsShowBothTorquesWithPhasesShaded) {
  const report::Section figure = jump_sections(*robot_, {}, *experiment_)[3];
  ASSERT_EQ(figure.plots.size(), 3u);
  const report::Plot& knee = figure.plots[1];
  ASSERT_EQ(knee.series.size(), 2u);
  EXPECT_THAT(knee.series[0].name, HasSubstr("equation (6)"));
  EXPECT_THAT(knee.series[1].name, HasSubstr("gear output"));
  EXPECT_GT(knee.series[0].x.size(), 1000u);
  std::vector<std::string> phases;
  for (const report::Shade& shade : knee.shades) phases.push_back(shade.name);
  EXPECT_THAT(phases, testing::IsSupersetOf({"thrust", "flight", "landing"}));
  EXPECT_NO_THROW(report::to_html({"jump", "", "", jump_sections(*robot_, {}, *experiment_)}));
}

}  // namespace
}  // namespace sprung
