#include "tools/common/report/html_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tools/common/report/report.h"

namespace sprung::report {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(NumberText, HasFiveSignificantDigitsAndNoMore) {
  EXPECT_EQ(number_text(3.21234567), "3.2123");
  EXPECT_EQ(number_text(-0.000123456789), "-0.00012346");
  EXPECT_EQ(number_text(188.0), "188");
}

TEST(NumberText, WhatIsNotFiniteIsADash) {
  EXPECT_EQ(number_text(kNan), "-");
  EXPECT_EQ(number_text(HUGE_VAL), "-");
}

TEST(EscapeHtml, NoTagEntityOrQuoteGetsThrough) {
  EXPECT_EQ(escape_html("<b a=\"1\" b='2'>R&D</b>"),
            "&lt;b a=&quot;1&quot; b=&#39;2&#39;&gt;R&amp;D&lt;/b&gt;");
  EXPECT_EQ(escape_html("24 \u00b0C"), "24 \u00b0C");
}

TEST(EscapeScript, AScriptCannotBeEndedFromWithin) {
  EXPECT_EQ(escape_script("[\"</script>\"]"), "[\"\\u003c/script>\"]");
}

TEST(RoundedForPlot, SixDigitsWhereValuesAreSpreadOut) {
  EXPECT_THAT(rounded_for_plot({0.1 + 0.2, -1.23456789, 599.99912345}),
              testing::ElementsAre(0.3, -1.23457, 599.999));
}

TEST(RoundedForPlot, MoreDigitsWhereTheyLieCloseTogetherFarFromZero) {
  const std::vector<double> rounded = rounded_for_plot({1000000.0, 1000000.00012345678, 1000000.001});
  EXPECT_NEAR(rounded[1] - rounded[0], 0.00012345678, 1e-7);
}

TEST(RoundedForPlot, GapsStayGapsAndDoNotSpoilTheRest) {
  const std::vector<double> rounded = rounded_for_plot({1.0000004, kNan, HUGE_VAL, 2.0});
  EXPECT_EQ(rounded[0], 1.0);
  EXPECT_TRUE(std::isnan(rounded[1]));
  EXPECT_TRUE(std::isinf(rounded[2]));
  EXPECT_TRUE(std::isnan(rounded_for_plot({kNan})[0]));
}

TEST(RoundedForPlot, OneValueAndAllZeroAreNothingSpecial) {
  EXPECT_EQ(rounded_for_plot({1.23456789})[0], 1.23457);
  EXPECT_THAT(rounded_for_plot({0.0, 0.0}), testing::ElementsAre(0.0, 0.0));
  EXPECT_TRUE(rounded_for_plot({}).empty());
}

TEST(LooksNumeric, NumbersWithSignExponentUnitAndTheMissingOne) {
  for (const char* text : {"1", "-2.5", "+3e-5", ".5", "95 %", "12.1 Nm", "-"})
    EXPECT_TRUE(looks_numeric(text)) << text;
}

TEST(LooksNumeric, WordsAndRangesAreNot) {
  for (const char* text : {"", "<= 4", "knee", "infinity", "nan", "2 us jitter stated", "1..4 with load"}) {
    EXPECT_FALSE(looks_numeric(text)) << text;
  }
}

}  // namespace
}  // namespace sprung::report
