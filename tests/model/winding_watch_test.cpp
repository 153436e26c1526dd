#include "model/winding_watch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "signals/vec3.h"

namespace sprung {
namespace {

/// Warmth after `seconds` of a constant current, from the watch's state on.
double after(WindingWatch& watch, double current_A, double seconds, std::int64_t& time_us) {
  for (int i = 0; i <= static_cast<int>(100 * seconds); ++i) watch.add(current_A, time_us += 10'000);
  return watch.warmth();
}

TEST(WindingWatchTest, RatedCurrentForEverIsWell) {
  WindingWatch watch(2.0, 50.0);
  std::int64_t time_us = 0;
  EXPECT_NEAR(after(watch, 2.0, 50.0, time_us), 1.0 - std::exp(-1.0), 1e-3);
  EXPECT_NEAR(after(watch, -2.0, 500.0, time_us), 1.0, 1e-3);
  EXPECT_FALSE(watch.hot());
}

TEST(WindingWatchTest, FiveTimesTheRatedCurrentIsTooMuchAfterTwoSeconds) {
  WindingWatch watch(2.0, 50.0);
  std::int64_t time_us = 0;
  after(watch, 10.0, 1.9, time_us);
  EXPECT_FALSE(watch.warm());
  after(watch, 10.0, 0.3, time_us);  // 50 s * ln(25 / 24) = 2.04 s
  EXPECT_TRUE(watch.warm());
  EXPECT_FALSE(watch.hot());
  after(watch, 10.0, 0.5, time_us);
  EXPECT_TRUE(watch.hot());
}

TEST(WindingWatchTest, CoolsBeforeItIsGivenMoreAgain) {
  WindingWatch watch(2.0, 50.0);
  std::int64_t time_us = 0;
  after(watch, 10.0, 2.2, time_us);
  ASSERT_TRUE(watch.warm());
  after(watch, 0.0, 1.0, time_us);
  EXPECT_TRUE(watch.warm());
  after(watch, 0.0, 10.0, time_us);
  EXPECT_FALSE(watch.warm());
}

TEST(WindingWatchTest, WithoutATimeConstantNothingIsWatched) {
  WindingWatch watch(2.0, 0.0);
  std::int64_t time_us = 0;
  EXPECT_EQ(after(watch, 100.0, 100.0, time_us), 0.0);
  EXPECT_FALSE(watch.warm() || watch.hot());
}

TEST(WindingWatchTest, CurrentThatIsNoNumberIsAsTheOneBefore) {
  WindingWatch watch(2.0, 50.0);
  std::int64_t time_us = 0;
  after(watch, 10.0, 1.0, time_us);
  EXPECT_GT(after(watch, kNaN, 3.0, time_us), 1.0);
}

TEST(WindingWatchTest, SampleAfterALongSilenceIsBounded) {
  WindingWatch watch(2.0, 50.0);
  watch.add(2.0, 0);
  watch.add(2.0, 3'600'000'000);
  EXPECT_LE(watch.warmth(), 1.0);
}

TEST(WindingWatchTest, SaysWhenItWillBeWarmAndThatTheRatedCurrentNeverMakesItSo) {
  WindingWatch watch(2.0, 50.0);
  std::int64_t time_us = 0;
  EXPECT_TRUE(std::isnan(watch.warm_in_s()));
  after(watch, 4.0, 1.0, time_us);  // warm after 50 s * ln(4 / 3) = 14.4 s
  EXPECT_NEAR(watch.warm_in_s(), 13.4, 0.1);
  after(watch, 4.0, 13.6, time_us);
  EXPECT_EQ(watch.warm_in_s(), 0.0);
  WindingWatch rated(2.0, 50.0);
  after(rated, 1.99, 100.0, time_us);
  EXPECT_TRUE(std::isnan(rated.warm_in_s()));
}

}  // namespace
}  // namespace sprung
