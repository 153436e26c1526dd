#pragma once
/// Opens pages in a real browser: Debian's Chromium, without a screen.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "tests/tools/common/report/report_folder.h"

namespace sprung::report {

struct BrowserPage {
  int exit_status;
  std::string dom;  ///< as it is after the scripts
  std::string log;  ///< "CONSOLE" where a script complained
};

/// Chromium's own pages complain too, of a machine without a network for one.
inline std::string without_own_pages(const std::string& log) {
  std::istringstream in(log);
  std::string out;
  for (std::string line; std::getline(in, line);)
    if (line.find("source: chrome://") == std::string::npos) out += line + "\n";
  return out;
}

/// How many points each plot says are to be seen; -1: it has drawn nothing.
inline std::vector<int> points_drawn(const BrowserPage& page) {
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

/// Skips the test, aloud, where there is no Chromium.
class BrowserTest : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v chromium >/dev/null 2>&1") != 0) {
      GTEST_SKIP() << "chromium is not installed: no report was opened. Run ./setup.";
    }
  }

  /// The page that was written to html_.
  /// @param part "#picture", as what makes pictures opens it.
  BrowserPage open_part(const std::string& part) const {
    const std::string in_folder = " " + folder_.path.string() + "/";
    const std::string command =
        "timeout -k 5 120 chromium --headless --no-sandbox --disable-gpu --no-first-run "
        "--disable-background-networking"
        " --disable-component-update --disable-sync --disable-dev-shm-usage --enable-logging=stderr"
        " --window-size=1200,900 --user-data-dir=" +
        folder_.path.string() + "/profile --dump-dom file://" + html_.string() + part + " >" + in_folder +
        "dom 2>" + in_folder + "log </dev/null";
    const int status = std::system(command.c_str());
    return {status, file_text(folder_.path / "dom"), without_own_pages(file_text(folder_.path / "log"))};
  }

  BrowserPage open() const { return open_part(""); }
  BrowserPage open(const std::string& html) const {
    std::ofstream(html_) << html;
    return open();
  }

  ReportFolder folder_;
  std::filesystem::path html_ = folder_.path / "report.html";
};

}  // namespace sprung::report
