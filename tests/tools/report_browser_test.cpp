/// A report in a real browser (Debian's Chromium, without a screen): it opens from disk, complains of nothing, and draws every plot.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>

#include "report_sample.h"
#include "tools/report/report_shell.h"

namespace sprung::report {
namespace {

namespace fs = std::filesystem;

/// An empty folder that is removed at the end.
struct Folder {
  fs::path path;
  Folder() {
    std::string name = (fs::temp_directory_path() / "sprung-report-XXXXXX").string();
    path = mkdtemp(name.data());
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
};

std::string contents(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

struct Page {
  int exit_status;
  std::string dom;  ///< as it is after the scripts
  std::string log;
};

Page open_in_browser(const Folder& folder, const fs::path& html) {
  const std::string command =
      "timeout -k 5 120 chromium --headless --no-sandbox --disable-gpu --no-first-run "
      "--disable-background-networking"
      " --disable-component-update --disable-sync --disable-dev-shm-usage --enable-logging=stderr "
      "--user-data-dir=" +
      (folder.path / "profile").string() + " --window-size=1200,900 --dump-dom file://" + html.string() +
      " >" + (folder.path / "dom").string() + " 2>" + (folder.path / "log").string() + " </dev/null";
  const int status = std::system(command.c_str());
  return {status, contents(folder.path / "dom"), contents(folder.path / "log")};
}

bool browser_is_there() { return std::system("command -v chromium >/dev/null 2>&1") == 0; }

/// How many points each plot says it has drawn; -1: it has drawn nothing.
std::vector<int> points_drawn(const std::string& dom) {
  std::vector<int> points;
  const std::regex canvas("<canvas[^>]*>"), drawn("data-drawn=\"([0-9]+)\"");
  for (auto it = std::sregex_iterator(dom.begin(), dom.end(), canvas); it != std::sregex_iterator(); ++it) {
    const std::string tag = it->str();
    std::smatch match;
    points.push_back(std::regex_search(tag, match, drawn) ? std::stoi(match[1]) : -1);
  }
  return points;
}

class ReportInBrowser : public testing::Test {
 protected:
  void SetUp() override {
    if (!browser_is_there()) GTEST_SKIP() << "chromium is not installed: no report was opened. Run ./setup.";
  }
  Folder folder_;
};

TEST_F(ReportInBrowser, EveryPlotIsDrawnAndTheConsoleIsSilent) {
  const fs::path html = folder_.path / "report.html";
  write_report(sample_report(600000), html);
  const Page page = open_in_browser(folder_, html);
  EXPECT_EQ(page.exit_status, 0) << page.log;
  EXPECT_THAT(page.log, testing::Not(testing::HasSubstr("CONSOLE")));
  EXPECT_THAT(points_drawn(page.dom),
              testing::ElementsAre(testing::Ge(9000), 301, testing::Ge(2000), 31, 400, 12 * 500));
}

TEST_F(ReportInBrowser, WhatBreaksAPlotIsSeenByThisTest) {
  const fs::path html = folder_.path / "report.html";
  std::string text = to_html(sample_report(100));
  text.replace(text.find("\"series\":["), std::string("\"series\":[").size(), "\"curves\":[");
  std::ofstream(html) << text;
  const Page page = open_in_browser(folder_, html);
  EXPECT_THAT(page.log, testing::HasSubstr("CONSOLE"));
  EXPECT_THAT(points_drawn(page.dom), testing::Contains(-1));
}

}  // namespace
}  // namespace sprung::report
