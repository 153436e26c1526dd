#include "tools/common/progress_bar.h"

#include <gtest/gtest.h>

#include <future>
#include <string>
#include <thread>

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

constexpr std::chrono::hours kNever{1};

TEST(ProgressBar, LeavesTheLineEmptyWhenAllIsDone) {
  std::string bytes;
  ProgressBar bar("tune", {true, kNever, [&](const std::string& text) { bytes += text; }});
  bar.show(1, 2);
  EXPECT_EQ(line_after(bytes).substr(0, 6), "tune  ");
  bar.show(2, 2);
  EXPECT_EQ(line_after(bytes), "");
}

TEST(ProgressBar, WhereNobodyCountsItSaysForHowLongItIsAtWork) {
  EXPECT_EQ(plain_progress_text("jump", 0, 0, 20.4), "jump: at work for 20 s");
  EXPECT_EQ(plain_progress_text("tune", 0, 40, 10.0), "tune: 0 of 40 done after 10 s");
  EXPECT_EQ(plain_progress_text("tune", 10, 40, 20.0), "tune: 10 of 40 done after 20 s, 60 s left");
}

/// An experiment whose first case takes minutes, in a script.
TEST(ProgressBar, WhereStandardErrorIsNoTerminalAPlainLineComesNowAndThen) {
  std::promise<std::string> first;
  bool told = false;
  const auto write = [&](const std::string& text) {
    if (!told) first.set_value(text);
    told = true;
  };
  ProgressBar bar("walk", {false, std::chrono::milliseconds(1), write});
  const std::string line = first.get_future().get();
  EXPECT_EQ(line.substr(0, 18), "walk: at work for ");
  EXPECT_EQ(line.back(), '\n');
}

TEST(ProgressBar, IsSilentOnceAllIsDone) {
  std::string after;
  bool done = false;
  const auto write = [&](const std::string& text) { after += done ? text : ""; };
  ProgressBar bar("walk", {false, std::chrono::milliseconds(1), write});
  bar.show(2, 2);
  done = true;
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_EQ(after, "");
}

TEST(ProgressBar, WhatIsSoonDoneWritesNothingWhereStandardErrorIsNoTerminal) {
  testing::internal::CaptureStderr();
  {
    ProgressBar bar("tune");
    bar.show(1, 2);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace sprung
