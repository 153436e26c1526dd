#include "tools/common/report/thinning.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace sprung::report {
namespace {

using testing::Contains;
using testing::ElementsAre;

constexpr double kReportThinningNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kTenMinutes = 600000;  // at 1 kHz

Column wave(std::size_t count) {
  Column y;
  for (std::size_t i = 0; i < count; ++i) y.push_back(std::sin(static_cast<double>(i) * 0.001));
  return y;
}

TEST(ThinInOrder, ShortSeriesAreLeftAlone) {
  const Column y = {3.0, kReportThinningNan, 1.0};
  EXPECT_THAT(thin_in_order({&y}, 3), ElementsAre(0, 1, 2));
  const Column nothing;
  EXPECT_TRUE(thin_in_order({&nothing}, 3).empty());
}

TEST(ThinInOrder, KeepsOnePeakOfOneSampleInTenMinutes) {
  Column y = wave(kTenMinutes);
  y[123457] = 50.0;
  y[123458] = -50.0;
  const auto kept = thin_in_order({&y}, 3000);
  EXPECT_LE(kept.size(), 3002u);
  EXPECT_GE(kept.size(), 2000u);
  EXPECT_THAT(kept, Contains(123457u));
  EXPECT_THAT(kept, Contains(123458u));
}

TEST(ThinInOrder, EveryStretchKeepsItsLowestAndHighest) {
  const Column y = wave(10000);
  const auto kept = thin_in_order({&y}, 200);  // 100 stretches of 100 samples
  for (std::size_t begin = 0; begin < y.size(); begin += 100) {
    const auto [low, high] = std::minmax_element(y.begin() + begin, y.begin() + begin + 100);
    EXPECT_THAT(kept, Contains(static_cast<std::size_t>(low - y.begin())));
    EXPECT_THAT(kept, Contains(static_cast<std::size_t>(high - y.begin())));
  }
}

TEST(ThinInOrder, FirstAndLastStayAndOrderIsKept) {
  const Column y = wave(5001);
  const auto kept = thin_in_order({&y}, 100);
  EXPECT_EQ(kept.front(), 0u);
  EXPECT_EQ(kept.back(), 5000u);
  EXPECT_TRUE(std::is_sorted(kept.begin(), kept.end()));
  EXPECT_EQ(std::adjacent_find(kept.begin(), kept.end()), kept.end());
}

TEST(ThinInOrder, AGapOfOneSampleStaysAGap) {
  Column y = wave(kTenMinutes);
  y[400001] = kReportThinningNan;
  EXPECT_THAT(thin_in_order({&y}, 1000), Contains(400001u));
}

TEST(ThinInOrder, APathKeepsItsExtremesInBothDirections) {
  Column x = wave(20000), y(20000, 0.0);
  x[777] = 9.0;
  y[15001] = -9.0;
  const auto kept = thin_in_order({&x, &y}, 400);
  EXPECT_THAT(kept, Contains(777u));
  EXPECT_THAT(kept, Contains(15001u));
  EXPECT_LE(kept.size(), 402u);
}

TEST(ThinInOrder, AllGapsAndTinyLimitsDoNoHarm) {
  const Column gaps(1000, kReportThinningNan);
  EXPECT_LE(thin_in_order({&gaps}, 10).size(), 7u);
  const Column y = wave(1000);
  EXPECT_LE(thin_in_order({&y}, 0).size(), 4u);
}

TEST(ThinCloud, SmallCloudsLoseOnlyWhatIsNotFinite) {
  EXPECT_THAT(thin_cloud({0.0, kReportThinningNan, 2.0, 3.0}, {1.0, 1.0, HUGE_VAL, 1.0}, 10),
              ElementsAre(0, 3));
  EXPECT_TRUE(thin_cloud({}, {}, 0).empty());
  EXPECT_TRUE(thin_cloud({kReportThinningNan}, {kReportThinningNan}, 0).empty());
}

TEST(ThinCloud, KeepsWithinTheLimitTheOutermostAndALonePoint) {
  Column x = wave(100000), y;
  for (std::size_t i = 0; i < x.size(); ++i) y.push_back(std::sin(static_cast<double>(i) * 0.7321));
  x[5000] = -7.0;
  x[5001] = 7.0;
  y[5002] = 30.0;
  y[5003] = -30.0;
  x[5005] = 3.0, y[5005] = 15.0;  // inside of what all span, far from the others
  const auto kept = thin_cloud(x, y, 500);
  EXPECT_LE(kept.size(), 504u);
  EXPECT_GE(kept.size(), 250u);
  for (const std::size_t lone : {5000u, 5001u, 5002u, 5003u, 5005u}) EXPECT_THAT(kept, Contains(lone));
}

TEST(ThinCloud, MorePointsStayWhereThereAreMore) {
  Column x, y;
  for (std::size_t i = 0; i < 50000; ++i) {
    x.push_back(i % 10 == 0 ? 0.5 + 0.5 * std::fabs(std::sin(static_cast<double>(i)))
                            : 0.3 * std::sin(static_cast<double>(i) * 1.7));
    y.push_back(std::sin(static_cast<double>(i) * 0.37));
  }
  const auto kept = thin_cloud(x, y, 1000);
  const auto dense = std::count_if(kept.begin(), kept.end(), [&x](std::size_t i) { return x[i] < 0.4; });
  EXPECT_GT(dense, static_cast<std::ptrdiff_t>(kept.size() * 6 / 10));
}

TEST(ThinCloud, OneSpotIsDrawnThough) {
  const Column same(10000, 4.0);
  EXPECT_FALSE(thin_cloud(same, same, 100).empty());
}

TEST(Pick, TakesTheChosenOnes) { EXPECT_THAT(pick({5.0, 6.0, 7.0}, {0, 2}), ElementsAre(5.0, 7.0)); }

}  // namespace
}  // namespace sprung::report
