#include "tools/logs/spy/plot_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sprung::spy {
namespace {

const double kNoNumber = std::nan("");

TEST(PlotText, SparklineGoesFromLowestToHighestBlock) {
  EXPECT_EQ(sparkline({0, 1, 2, 3, 4, 5, 6, 7}, 8), "▁▂▃▄▅▆▇█");
  EXPECT_EQ(sparkline({-5, 5}, 4), "  ▁█");
}

TEST(PlotText, SparklineShowsTheNewestAndGaps) {
  EXPECT_EQ(sparkline({9, 9, 0, kNoNumber, 1}, 3), "▁ █");
  EXPECT_EQ(sparkline({3, 3, 3}, 3), "▁▁▁");
  EXPECT_EQ(sparkline({}, 3), "   ");
  EXPECT_EQ(sparkline({kNoNumber, std::numeric_limits<double>::infinity()}, 2), "  ");
}

TEST(PlotText, BrailleDrawsARampFromCornerToCorner) {
  EXPECT_THAT(braille_plot({0, 1, 2, 3}, 2, 1), testing::ElementsAre("⣠⠞"));
  const auto lines = braille_plot({0, 1, 2, 3, 4, 5, 6, 7}, 4, 2);
  EXPECT_THAT(lines, testing::ElementsAre("⠀⠀⣠⠞", "⣠⠞⠁⠀"));
}

TEST(PlotText, BrailleKeepsPeaksThatFallBetweenItsColumns) {
  std::vector<double> values(1000, 0.0);
  values[437] = 1.0;
  const auto lines = braille_plot(values, 10, 2);
  EXPECT_NE(lines[0], "⠀⠀⠀⠀⠀⠀⠀⠀⠀⠀");
}

TEST(PlotText, BrailleLeavesGapsAndBearsNothing) {
  EXPECT_THAT(braille_plot({}, 2, 1), testing::ElementsAre("⠀⠀"));
  EXPECT_THAT(braille_plot({kNoNumber, kNoNumber}, 1, 1), testing::ElementsAre("⠀"));
  EXPECT_THAT(braille_plot({1, 1, kNoNumber, kNoNumber}, 2, 1), testing::ElementsAre("⣀⠀"));
}

TEST(PlotText, RangeLeavesOutWhatIsNoNumber) {
  const Range range = range_of({kNoNumber, 2, -std::numeric_limits<double>::infinity(), -1});
  EXPECT_TRUE(range.known);
  EXPECT_EQ(range.low, -1);
  EXPECT_EQ(range.high, 2);
  EXPECT_FALSE(range_of({kNoNumber}).known);
}

TEST(PlotText, FitCountsLettersNotBytes) {
  EXPECT_EQ(fit("ab", 4), "ab  ");
  EXPECT_EQ(fit("▁▂▃", 3), "▁▂▃");
  EXPECT_EQ(fit("▁▂▃▄", 3), "▁▂~");
  EXPECT_EQ(fit("abc", 1), "~");
  EXPECT_EQ(fit("abc", 0), "");
}

}  // namespace
}  // namespace sprung::spy
