#include "runtime/utc_text.h"

#include <gtest/gtest.h>

#include <limits>

namespace sprung {
namespace {

constexpr std::int64_t kSome_us = 1'700'000'000'123'456;

TEST(UtcText, HasAsManyDecimalsAsAskedFor) {
  EXPECT_EQ(utc_text(kSome_us), "2023-11-14T22:13:20");
  EXPECT_EQ(utc_text(kSome_us, ' ', 3), "2023-11-14 22:13:20.123");
  EXPECT_EQ(utc_text(kSome_us, 'T', 6), "2023-11-14T22:13:20.123456");
}

TEST(UtcText, BeforeTheEpochCountsBack) {
  EXPECT_EQ(utc_text(-1, ' ', 3), "1969-12-31 23:59:59.999");
  EXPECT_EQ(utc_text(-1'000'000), "1969-12-31T23:59:59");
}

TEST(UtcText, AnyNumberIsAText) {
  constexpr auto kMost = std::numeric_limits<std::int64_t>::max();
  constexpr auto kLeast = std::numeric_limits<std::int64_t>::min();
  EXPECT_EQ(utc_text(kMost, ' ', 3), "294247-01-10 04:00:54.775");
  EXPECT_EQ(utc_text(kLeast, 'T', 6), "-290308-12-21T19:59:05.224192");
}

TEST(DaysBetween, CountsLeapDaysAndTakesWhatBeginsWithADate) {
  EXPECT_EQ(days_between("2028-02-01", "2028-05-02"), 91);
  EXPECT_EQ(days_between("2026-11-21T06:00:00Z", "2026-11-22"), 1);
  EXPECT_EQ(days_between("2026-12-31", "2027-01-01"), 1);
  EXPECT_EQ(days_between("", "2027-01-01"), 0);
  EXPECT_EQ(days_between("2026-12-31", "soon"), 0);
}

}  // namespace
}  // namespace sprung
