/// A report in a real browser (Debian's Chromium, without a screen): it opens from disk, complains of nothing, and draws every plot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <regex>
#include <vector>

#include "report_folder.h"
#include "report_sample.h"
#include "tools/report/report_shell.h"

namespace sprung::report {
namespace {

using testing::HasSubstr;
using testing::Not;

struct Page {
  int exit_status;
  std::string dom;  ///< as it is after the scripts
  std::string log;
};

/// How many points each plot says are to be seen; -1: it has drawn nothing.
std::vector<int> points_drawn(const Page& page) {
  std::vector<int> points;
  const std::regex canvas("<canvas[^>]*>"), drawn("data-drawn=\"([0-9]+)\"");
  for (auto it = std::sregex_iterator(page.dom.begin(), page.dom.end(), canvas); it != std::sregex_iterator();
       ++it) {
    const std::string tag = it->str();
    std::smatch match;
    points.push_back(std::regex_search(tag, match, drawn) ? std::stoi(match[1]) : -1);
  }
  return points;
}

/// Text with one place changed, which must be there.
std::string with(std::string text, const std::string& old, const std::string& changed) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return at == std::string::npos ? text : text.replace(at, old.size(), changed);
}

class ReportInBrowser : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v chromium >/dev/null 2>&1") != 0) {
      GTEST_SKIP() << "chromium is not installed: no report was opened. Run ./setup.";
    }
  }

  Page open() const {
    const std::string in_folder = " " + folder_.path.string() + "/";
    const std::string command =
        "timeout -k 5 120 chromium --headless --no-sandbox --disable-gpu --no-first-run "
        "--disable-background-networking"
        " --disable-component-update --disable-sync --disable-dev-shm-usage --enable-logging=stderr"
        " --window-size=1200,900 --user-data-dir=" +
        folder_.path.string() + "/profile --dump-dom file://" + html_.string() + " >" + in_folder + "dom 2>" +
        in_folder + "log </dev/null";
    const int status = std::system(command.c_str());
    return {status, file_text(folder_.path / "dom"), file_text(folder_.path / "log")};
  }

  Page open(const std::string& html) const {
    std::ofstream(html_) << html;
    return open();
  }

  ReportFolder folder_;
  std::filesystem::path html_ = folder_.path / "report.html";
};

TEST_F(ReportInBrowser, EveryPlotIsDrawnAndTheConsoleIsSilent) {
  write_report(sample_report(600000), html_);
  const Page page = open();
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

TEST_F(ReportInBrowser, WhatBreaksAPlotIsSeenByThisTest) {
  const Page page = open(with(to_html(sample_report(100)), "\"series\":[", "\"curves\":["));
  EXPECT_THAT(page.log, HasSubstr("CONSOLE"));
  EXPECT_THAT(points_drawn(page), testing::Contains(-1));
}

}  // namespace
}  // namespace sprung::report
