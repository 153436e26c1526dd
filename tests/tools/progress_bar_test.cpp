#include "tools/experiments/progress_bar.h"

#include <gtest/gtest.h>

#include <string>

namespace sprung {
namespace {

TEST(ProgressBar, ShowsShareCountAndTheTimeThatIsLeft) {
  EXPECT_EQ(progress_text("tune", 0, 40, 0.0), "tune  [........................]  0 of 40");
  EXPECT_EQ(progress_text("tune", 10, 40, 5.0), "tune  [######..................]  10 of 40, 15 s left");
  EXPECT_EQ(progress_text("tune", 40, 40, 20.0), "tune  [########################]  40 of 40");
  EXPECT_EQ(progress_text("none", 0, 0, 0.0), "none  [########################]  0 of 0");
}

/// What a terminal's line shows after these bytes.
std::string line_after(const std::string& bytes) {
  const std::size_t wiped = bytes.rfind("\r\x1b[K");
  return wiped == std::string::npos ? bytes : bytes.substr(wiped + 4);
}

TEST(ProgressBar, LeavesTheLineEmptyWhenAllIsDone) {
  ProgressBar bar("tune", true);
  testing::internal::CaptureStderr();
  bar.show(1, 2);
  EXPECT_EQ(line_after(testing::internal::GetCapturedStderr()).substr(0, 6), "tune  ");
  testing::internal::CaptureStderr();
  bar.show(1, 2);
  bar.show(2, 2);
  EXPECT_EQ(line_after(testing::internal::GetCapturedStderr()), "");
}

TEST(ProgressBar, WritesNothingWhereStandardErrorIsNoTerminal) {
  testing::internal::CaptureStderr();
  {
    ProgressBar bar("tune");
    bar.show(1, 2);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace sprung
