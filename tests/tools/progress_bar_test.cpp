#include "tools/experiments/progress_bar.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

TEST(ProgressBar, ShowsShareCountAndTheTimeThatIsLeft) {
  EXPECT_EQ(progress_text("tune", 0, 40, 0.0), "tune  [........................]  0 of 40");
  EXPECT_EQ(progress_text("tune", 10, 40, 5.0), "tune  [######..................]  10 of 40, 15 s left");
  EXPECT_EQ(progress_text("tune", 40, 40, 20.0), "tune  [########################]  40 of 40");
  EXPECT_EQ(progress_text("none", 0, 0, 0.0), "none  [########################]  0 of 0");
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
