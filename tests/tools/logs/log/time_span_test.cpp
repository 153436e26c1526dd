#include "tools/logs/log/time_span.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace sprung::log {
namespace {

constexpr std::int64_t kBegin_us = 1'700'000'000'000'000;
const LogExtent kExtent{kBegin_us, 100.0};

bool holds(const std::string& from, const std::string& to, double time_s) {
  return SpanTest(parse_span(from, to), kExtent)
      .holds(time_s, kBegin_us + static_cast<std::int64_t>(1e6 * time_s));
}

TEST(TimeSpan, NothingIsEverything) {
  EXPECT_TRUE(holds("", "", 0.0));
  EXPECT_TRUE(holds("", "", 1e9));
  EXPECT_TRUE(parse_span("", "").everything());
}

TEST(TimeSpan, SecondsCountFromTheBeginAndTheEndIsLeftOut) {
  EXPECT_FALSE(holds("1.5", "3s", 1.499));
  EXPECT_TRUE(holds("1.5", "3s", 1.5));
  EXPECT_TRUE(holds("1.5", "3s", 2.999));
  EXPECT_FALSE(holds("1.5", "3s", 3.0));
}

TEST(TimeSpan, AMinusCountsFromTheEnd) {
  EXPECT_TRUE(parse_span("-5", "").needs_end());
  EXPECT_FALSE(parse_span("5", "7").needs_end());
  EXPECT_FALSE(holds("-5", "", 94.9));
  EXPECT_TRUE(holds("-5", "", 95.0));
  EXPECT_TRUE(holds("", "-5", 94.9));
  EXPECT_FALSE(holds("", "-5", 95.0));
  EXPECT_FALSE(holds("-0", "", 99.9));
}

TEST(TimeSpan, DatesAndUnixTimesAreAbsolute) {
  EXPECT_EQ(parse_time("2023-11-14T22:13:20Z").utc_us, kBegin_us);
  EXPECT_EQ(parse_time("2023-11-14T22:13:20.25").utc_us, kBegin_us + 250'000);
  EXPECT_EQ(parse_time("@1700000000.25").utc_us, kBegin_us + 250'000);
  EXPECT_FALSE(holds("@1700000002", "2023-11-14T22:13:30Z", 1.9));
  EXPECT_TRUE(holds("@1700000002", "2023-11-14T22:13:30Z", 2.0));
  EXPECT_FALSE(holds("@1700000002", "2023-11-14T22:13:30Z", 10.0));
}

TEST(TimeSpan, OneThatEndsBeforeItBeginsIsRefused) {
  EXPECT_THROW(parse_span("5", "3"), std::invalid_argument);
  EXPECT_THROW(parse_span("-3", "-5"), std::invalid_argument);
  EXPECT_THROW(parse_span("@1700000010", "2023-11-14T22:13:20Z"), std::invalid_argument);
  EXPECT_NO_THROW(parse_span("5", "-5")) << "only the log can tell";
  EXPECT_NO_THROW(parse_span("3", "3"));
}

TEST(TimeSpan, WhatIsNoTimeIsNamedWithTheWaysToWriteOne) {
  for (const char* text : {"soon", "1.5x", "@", "@x", "2023-13-14T22:13:20Z", "2023-11-14T22:13",
                           "2023-11-14T25:13:20Z", "2023-02-30T00:00:00Z", "2023-11-14T-1:13:20Z",
                           "2023-11-14T22:13:20+01", "nan", "inf", "@1e300", "1e999", ""}) {
    try {
      parse_time(text);
      FAIL() << text;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("'" + std::string(text) + "' is no time"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace sprung::log
