#include "tools/lab/jump/live_jump_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/common/report/report_browser.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::Each;
using testing::Ge;
using testing::HasSubstr;
using testing::Not;
using testing::SizeIs;

JumpResult jump_of(double height_mm, bool upright) {
  JumpResult jump;
  jump.height_mm = height_mm;
  jump.takeoff_time_ms = 200.0;
  jump.touchdown_time_ms = 600.0;
  jump.peak_knee_torque_Nm = 155.0;
  jump.peak_knee_output_torque_Nm = 26.0;
  jump.landing_knee_torque_Nm = 9.5;
  jump.landing_knee_output_torque_Nm = 47.5;
  jump.upright = upright;
  return jump;
}

/// Two jumps, the second fell; the first one's samples go through thrust, flight and landing.
LiveJumps two_jumps() {
  LiveJumps live{"single_leg", "best", JumpMode::kHybrid, "sprung jump --count 2 --html a.html", {}, {}};
  live.jumps = {jump_of(186.0, true), jump_of(kNaN, false)};
  for (int k = 0; k < 900; ++k) {
    const MotionPhase phase = k < 200   ? MotionPhase::kThrust
                              : k < 600 ? MotionPhase::kFlight
                                        : MotionPhase::kLanding;
    live.samples.push_back({1e-3 * k, -0.4, -0.41, 0.5, 60.0, 1.0, 2.0, 0.1 * k, 0.05 * k, phase});
  }
  return live;
}

TEST(LiveJumpReport, SaysWhatRanAndHowItIsMadeAgain) {
  const report::Report page = live_jump_report(two_jumps());
  EXPECT_EQ(page.title, "Jumps of single_leg");
  EXPECT_THAT(page.subtitle, AllOf(HasSubstr("preset best"), HasSubstr("mode hybrid"),
                                   HasSubstr("simulated drives"), HasSubstr("sprung ")));
  EXPECT_EQ(page.command, "sprung jump --count 2 --html a.html");
}

TEST(LiveJumpReport, EveryJumpIsARowWithBothTorquesAndWhetherItStoodAgain) {
  const report::Report page = live_jump_report(two_jumps());
  ASSERT_THAT(page.sections, SizeIs(2));
  EXPECT_THAT(page.sections[0].text[0], HasSubstr("2 time(s)"));
  const report::Table& table = page.sections[0].tables.at(0);
  ASSERT_THAT(table.rows, SizeIs(2));
  EXPECT_THAT(table.rows, Each(SizeIs(table.columns.size())));
  const std::vector<report::Cell>& first = table.rows[0];
  const char* expected[] = {"1", "186", "600", "155", "26", "9.5", "47.5", "yes"};
  for (std::size_t i = 0; i < first.size(); ++i) EXPECT_EQ(first[i].text, expected[i]) << table.columns[i];
  EXPECT_EQ(first.back().mark, report::Mark::kGood);
  EXPECT_EQ(table.rows[1][0].text, "2");
  EXPECT_EQ(table.rows[1][1].text, "-");  // a leg that fell has no height
  EXPECT_EQ(table.rows[1].back().text, "no");
  EXPECT_EQ(table.rows[1].back().mark, report::Mark::kBad);
}

TEST(LiveJumpReport, FirstJumpIsDrawnOverItsPhases) {
  const report::Section figure = live_jump_report(two_jumps()).sections[1];
  EXPECT_THAT(figure.heading, AllOf(HasSubstr("Hybrid"), HasSubstr("preset best")));
  ASSERT_THAT(figure.plots, SizeIs(3));
  const report::Plot& knee = figure.plots[1];
  ASSERT_THAT(knee.shades, SizeIs(3));
  EXPECT_EQ(knee.shades[1].name, "flight");
  EXPECT_DOUBLE_EQ(knee.shades[1].from, 0.2);
  EXPECT_DOUBLE_EQ(knee.markers.at(1).x, 0.6);
  EXPECT_DOUBLE_EQ(knee.series[0].y.back(), 89.9);   // motor side
  EXPECT_DOUBLE_EQ(knee.series[1].y.back(), 44.95);  // gear output
}

TEST(LiveJumpReport, WithoutAJumpThereIsNoPage) {
  LiveJumps none = two_jumps();
  none.jumps.clear();
  EXPECT_THROW(live_jump_report(none), std::invalid_argument);
}

using LiveJumpPage = report::BrowserTest;

TEST_F(LiveJumpPage, IsDrawnAndTheConsoleIsSilent) {
  const report::BrowserPage page = open(report::to_html(live_jump_report(two_jumps())));
  EXPECT_EQ(page.exit_status, 0) << page.log;
  EXPECT_THAT(page.log, Not(HasSubstr("CONSOLE")));
  EXPECT_THAT(report::points_drawn(page), AllOf(SizeIs(3), Each(Ge(2 * 900))));
}

}  // namespace
}  // namespace sprung
