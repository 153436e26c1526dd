/// Pages of experiments in a real browser: the index of all, and the jumps', of a log as it truly is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/robot_loader.h"
#include "tests/tools/common/report/report_browser.h"
#include "tests/tools/lab/run/experiment_index_sample.h"
#include "tools/lab/jump/jump_report.h"

namespace sprung {
namespace {

using report::BrowserPage;
using report::points_drawn;
using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::Gt;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

using ExperimentPages = report::BrowserTest;

TEST_F(ExperimentPages, IndexIsDrawnLeadsToEveryExperimentAndTheConsoleIsSilent) {
  const BrowserPage page = open(report::to_html(experiment_index(sample_heading(), sample_experiments())));
  EXPECT_EQ(page.exit_status, 0) << page.log;
  EXPECT_THAT(page.log, Not(HasSubstr("CONSOLE")));
  EXPECT_THAT(points_drawn(page), ElementsAre(3));
  EXPECT_THAT(page.dom, AllOf(HasSubstr("href=\"jump.html\""), HasSubstr("href=\"drop.html\""),
                              HasSubstr("the plant failed")));
}

TEST_F(ExperimentPages, PageOfAFailedExperimentOpensWithoutPlots) {
  const BrowserPage page = open(report::to_html(experiment_page(sample_heading(), sample_experiments()[1])));
  EXPECT_THAT(page.log, Not(HasSubstr("CONSOLE")));
  EXPECT_THAT(points_drawn(page), SizeIs(0));
  EXPECT_THAT(page.dom, HasSubstr("the plant failed"));
}

TEST_F(ExperimentPages, JumpsOfTheSimulatedLegAreDrawnInAllModes) {
  const RobotConfig robot = load_robot("single_leg");
  const JumpExperiment jumps = run_jump_experiment(robot, "paper", {}, run_in_process);
  const BrowserPage page = open(report::to_html({"Jumps", "", "", jump_sections(robot, {}, jumps)}));
  EXPECT_EQ(page.exit_status, 0) << page.log;
  EXPECT_THAT(page.log, Not(HasSubstr("CONSOLE")));
  EXPECT_THAT(points_drawn(page), AllOf(SizeIs(4 * 3), Each(Gt(2000))));  // foot, knee and hip in each mode
  EXPECT_THAT(page.dom, HasSubstr("jump.hybrid.height"));
}

}  // namespace
}  // namespace sprung
