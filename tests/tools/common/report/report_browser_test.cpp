/// A report in a real browser (Debian's Chromium, without a screen): it opens from disk, complains of
/// nothing, and draws every plot.
#include "tests/tools/common/report/report_browser.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/tools/common/report/report_sample.h"
#include "tools/common/report/report_shell.h"

namespace sprung::report {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Text with one place changed, which must be there.
std::string with(std::string text, const std::string& old, const std::string& changed) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return at == std::string::npos ? text : text.replace(at, old.size(), changed);
}

using ReportInBrowser = BrowserTest;

TEST_F(ReportInBrowser, EveryPlotIsDrawnAndTheConsoleIsSilent) {
  write_report(sample_report(600000), html_);
  const BrowserPage page = open();
  EXPECT_EQ(page.exit_status, 0) << page.log;
  EXPECT_THAT(page.log, Not(HasSubstr("CONSOLE")));
  EXPECT_THAT(points_drawn(page),
              testing::ElementsAre(testing::Ge(9000), 301, testing::Ge(2000), 31, 400, 12 * 500));
  EXPECT_THAT(page.dom, HasSubstr("from up to 600000 samples"));
}

TEST_F(ReportInBrowser, DraggingZoomsThePlotsOfTheSectionAndADoubleClickShowsAllAgain) {
  const std::string begin =
      "<script>\nHTMLElement.prototype.setPointerCapture = () => {};\n"
      "const canvas = document.querySelector('canvas'), box = canvas.getBoundingClientRect();\n"
      "const send = (type, x) => canvas.dispatchEvent(new PointerEvent(type, {clientX: box.left + x, "
      "clientY: box.top + 99}));\n"
      "send('pointerdown', 400); send('pointermove', 600); send('pointerup', 600);\n";
  const std::string end = "</script>\n</body>";
  const std::string html = to_html(sample_report(301));
  const std::vector<int> all = points_drawn(open(html));
  const std::vector<int> zoomed = points_drawn(open(with(html, "</body>", begin + end)));
  ASSERT_EQ(zoomed.size(), 6u);
  EXPECT_NEAR(zoomed[1], 301 * 200 / 1040, 6);  // the plot is about 1040 pixels wide
  EXPECT_LT(zoomed[0], all[0] / 4);
  EXPECT_THAT(std::vector<int>(zoomed.begin() + 2, zoomed.end()),
              testing::ElementsAreArray(std::vector<int>(all.begin() + 2, all.end())));
  EXPECT_EQ(points_drawn(open(with(html, "</body>", begin + "send('dblclick', 0);\n" + end))), all);
}

/// The window is 900 px high; what Chromium keeps of it for itself is in innerHeight.
TEST_F(ReportInBrowser, APictureHasEveryPlotInItsWindow) {
  const std::string measure =
      "<script>\nconst shown = [...document.querySelectorAll('canvas')].map(c => "
      "c.getBoundingClientRect());\n"
      "document.title = 'in the window: ' + shown.filter(b => b.height > 60 && b.bottom <= "
      "innerHeight).length;\n"
      "</script>\n</body>";
  Report two = sample_report(301);
  two.sections = {two.sections[1]};
  two.sections.front().text.clear();
  ASSERT_EQ(two.sections.front().plots.size(), 2u);
  std::ofstream(html_) << with(to_html(two), "</body>", measure);
  const BrowserPage picture = open_part("#picture");
  EXPECT_THAT(picture.log, Not(HasSubstr("CONSOLE")));
  EXPECT_THAT(picture.dom, HasSubstr("<title>in the window: 2<"));
  EXPECT_THAT(points_drawn(picture), testing::Each(testing::Gt(0)));
}

TEST_F(ReportInBrowser, WhatBreaksAPlotIsSeenByThisTest) {
  const BrowserPage page = open(with(to_html(sample_report(100)), "\"series\":[", "\"curves\":["));
  EXPECT_THAT(page.log, HasSubstr("CONSOLE"));
  EXPECT_THAT(points_drawn(page), testing::Contains(-1));
}

}  // namespace
}  // namespace sprung::report
