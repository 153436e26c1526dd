#include "planner/motion_hold.h"

#include <gtest/gtest.h>

#include <limits>

#include "signals/vec3.h"

namespace sprung {
namespace {

TEST(MotionHold, MotionWithoutOneLastsUntilTold) {
  MotionHold hold;
  hold.begin(kNaN, 0);
  EXPECT_FALSE(hold.take_lapse(10'000'000'000));
  EXPECT_FALSE(hold.renew(1.0, 0)) << "nothing is held";
}

TEST(MotionHold, LapsesOnceWhenItsTimeIsOver) {
  MotionHold hold;
  hold.begin(0.5, 1'000'000);
  EXPECT_FALSE(hold.take_lapse(1'500'000));
  EXPECT_TRUE(hold.take_lapse(1'500'001));
  EXPECT_FALSE(hold.take_lapse(1'500'002));
}

TEST(MotionHold, RenewalCountsFromWhenItCame) {
  MotionHold hold;
  hold.begin(0.5, 0);
  EXPECT_TRUE(hold.renew(1.0, 400'000));
  EXPECT_FALSE(hold.take_lapse(1'400'000));
  EXPECT_TRUE(hold.take_lapse(1'400'001));
  EXPECT_FALSE(hold.renew(1.0, 1'400'002)) << "too late";
}

TEST(MotionHold, MotionThatGoesOnOtherwiseHasTheNewHoldOrNone) {
  MotionHold hold;
  hold.begin(0.5, 0);
  hold.begin(kNaN, 100'000);
  EXPECT_FALSE(hold.take_lapse(10'000'000));
}

TEST(MotionHold, OnlyTimesThatCanBeAreTaken) {
  for (const double good : {kNaN, 0.001, 1.0, 3600.0}) EXPECT_EQ(MotionHold::validate(good), nullptr) << good;
  const double infinite = std::numeric_limits<double>::infinity();
  for (const double bad : {0.0, -1.0, 3600.1, infinite, -infinite})
    EXPECT_STREQ(MotionHold::validate(bad), "a hold lasts more than 0 s and at most 3600 s") << bad;
}

}  // namespace
}  // namespace sprung
