#include "runtime/log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace sprung {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

std::string logged(const char* level) {
  if (level == nullptr) {
    unsetenv("SPRUNG_LOG");
  } else {
    setenv("SPRUNG_LOG", level, 1);
  }
  ::testing::internal::CaptureStderr();
  start_log("sprung-x");
  log_debug("a debug {} line");  // braces are text, not a format
  log_info("an info line");
  log_warn("a warning");
  log_error("an error");
  unsetenv("SPRUNG_LOG");
  return ::testing::internal::GetCapturedStderr();
}

TEST(Log, NamesLevelAndProcess) {
  EXPECT_THAT(logged(nullptr), AllOf(HasSubstr("info sprung-x: an info line\n"),
                                     HasSubstr("error sprung-x: an error\n"), Not(HasSubstr("debug"))));
}

TEST(Log, LevelComesFromTheEnvironment) {
  EXPECT_THAT(logged("debug"), HasSubstr("debug sprung-x: a debug {} line\n"));
  EXPECT_THAT(logged("error"), AllOf(HasSubstr("an error"), Not(HasSubstr("a warning"))));
  EXPECT_EQ(logged("off"), "");
}

TEST(LogLimit, LetsOneThroughInAnIntervalAndCountsTheOthers) {
  LogLimit limit(1'000'000);
  EXPECT_TRUE(limit.allow(0));
  EXPECT_FALSE(limit.allow(1));
  EXPECT_FALSE(limit.allow(999'999));
  EXPECT_TRUE(limit.allow(1'000'000));
  EXPECT_EQ(limit.kept_back(), 2);
  EXPECT_TRUE(limit.allow(5'000'000));
  EXPECT_EQ(limit.kept_back(), 0);
}

}  // namespace
}  // namespace sprung
