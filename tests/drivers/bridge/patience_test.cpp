#include "drivers/bridge/patience.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

TEST(Patience, AsksAgainEveryFiftyMilliseconds) {
  Patience patience;
  patience.begin(1'000);
  EXPECT_FALSE(patience.repeat_due(50'999));
  EXPECT_TRUE(patience.repeat_due(51'000));
  EXPECT_FALSE(patience.repeat_due(51'001));
  EXPECT_TRUE(patience.repeat_due(101'000));
}

TEST(Patience, FirstTimeIsLongLaterOnesAreShort) {
  Patience patience;
  patience.begin(0);
  EXPECT_FALSE(patience.over(999'999));
  EXPECT_TRUE(patience.over(1'000'000));
  patience.gave_up();
  patience.begin(2'000'000);
  EXPECT_FALSE(patience.over(2'004'999));
  EXPECT_TRUE(patience.over(2'005'000));
}

TEST(Patience, PartnerThatIsBackGetsTheLongTimeAgain) {
  Patience patience;
  patience.gave_up();
  patience.answered();
  patience.begin(0);
  EXPECT_FALSE(patience.over(900'000));
}

TEST(Patience, WakesForWhateverComesFirst) {
  Patience patience;
  patience.begin(0);
  EXPECT_EQ(patience.wake_us(), Patience::kRepeat_us);
  patience.gave_up();
  patience.begin(0);
  EXPECT_EQ(patience.wake_us(), Patience::kGone_us);
}

}  // namespace
}  // namespace sprung
