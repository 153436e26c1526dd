#include "drivers/bridge/timeout.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

TEST(Timeout, AsksAgainEveryFiftyMilliseconds) {
  Timeout timeout;
  timeout.begin(1'000);
  EXPECT_FALSE(timeout.repeat_due(50'999));
  EXPECT_TRUE(timeout.repeat_due(51'000));
  EXPECT_FALSE(timeout.repeat_due(51'001));
  EXPECT_TRUE(timeout.repeat_due(101'000));
}

TEST(Timeout, FirstTimeIsLongLaterOnesAreShort) {
  Timeout timeout;
  timeout.begin(0);
  EXPECT_FALSE(timeout.over(999'999));
  EXPECT_TRUE(timeout.over(1'000'000));
  timeout.gave_up();
  timeout.begin(2'000'000);
  EXPECT_FALSE(timeout.over(2'004'999));
  EXPECT_TRUE(timeout.over(2'005'000));
}

TEST(Timeout, PartnerThatIsBackGetsTheLongTimeAgain) {
  Timeout timeout;
  timeout.gave_up();
  timeout.answered();
  timeout.begin(0);
  EXPECT_FALSE(timeout.over(900'000));
}

TEST(Timeout, WakesForWhateverComesFirst) {
  Timeout timeout;
  timeout.begin(0);
  EXPECT_EQ(timeout.wake_us(), Timeout::kRepeat_us);
  timeout.gave_up();
  timeout.begin(0);
  EXPECT_EQ(timeout.wake_us(), Timeout::kGone_us);
}

}  // namespace
}  // namespace sprung
