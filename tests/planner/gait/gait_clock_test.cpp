#include "planner/gait/gait_clock.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

constexpr double kGaitClockStep_s = 0.002;

GaitConfig gait(double period_s, double duty, std::vector<double> offsets) {
  GaitConfig out;
  out.period_s = period_s;
  out.duty = duty;
  out.offsets = std::move(offsets);
  return out;
}

const GaitConfig kTrot = gait(0.6, 0.6, {0.0, 0.5, 0.5, 0.0});
const GaitConfig kCrawl = gait(3.6, 0.86, {0.25, 0.75, 0.0, 0.5});

class GaitClockTest : public testing::Test {
 protected:
  void begin(const GaitConfig& config) {
    config_ = config;
    clock_.begin(config_, 4);
  }
  /// Feet land when their swing's time is over. @return most that were in the air at once.
  int run(double seconds) {
    int most = 0;
    for (int k = 0; k < static_cast<int>(seconds / kGaitClockStep_s + 0.5); ++k) {
      clock_.advance(kGaitClockStep_s);
      int air = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        if (clock_.swings(i) && clock_.swing_share(i) >= 1.0) clock_.land(i);
        air += clock_.swings(i) ? 1 : 0;
      }
      most = std::max(most, air);
    }
    return most;
  }
  double until_first_swing_s() {
    double time_s = 0.0;
    while (clock_.all_stand() && time_s < 10.0) {
      clock_.advance(kGaitClockStep_s);
      time_s += kGaitClockStep_s;
    }
    return time_s;
  }

  GaitConfig config_;
  GaitClock clock_;
};

TEST_F(GaitClockTest, SwingAndStanceShareThePeriod) {
  begin(kTrot);
  EXPECT_NEAR(clock_.swing_s(), 0.24, 1e-12);
  EXPECT_NEAR(clock_.stance_s(), 0.36, 1e-12);
}

TEST_F(GaitClockTest, BeginsAsLongBeforeTheFirstSwingAsAllFeetStand) {
  begin(kTrot);  // both pairs stand for 0.6 - 0.5 of the period
  EXPECT_TRUE(clock_.all_stand());
  EXPECT_NEAR(until_first_swing_s(), 0.06, 1.5 * kGaitClockStep_s);
  begin(kCrawl);  // 0.25 - 0.14 of it
  EXPECT_NEAR(until_first_swing_s(), 0.11 * 3.6, 1.5 * kGaitClockStep_s);
}

TEST_F(GaitClockTest, DiagonalsOfATrotSwingTogetherAndInTurn) {
  begin(kTrot);
  run(0.08);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(clock_.swings(i), i == 0 || i == 3) << i;
  run(0.3);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(clock_.swings(i), i == 1 || i == 2) << i;
}

TEST_F(GaitClockTest, CrawlLiftsOneFootAtATime) {
  begin(kCrawl);
  EXPECT_EQ(run(15.0), 1);
  EXPECT_EQ(clock_.rounds(), 4);
}

TEST_F(GaitClockTest, EveryLegStepsOnceInAPeriod) {
  for (const GaitConfig& config : {kTrot, kCrawl, gait(0.8, 0.7, {0.25, 0.75, 0.0, 0.5})}) {
    begin(config);
    run(10.0 * config.period_s);
    EXPECT_NEAR(clock_.rounds(), 10, 1) << config.period_s;
  }
}

TEST_F(GaitClockTest, EveryShippedGaitKeepsTwoFeetOnTheGround) {
  for (const GaitConfig& config : load_robot("pegasus").gaits) {
    begin(config);
    EXPECT_LE(run(8.0), 2) << config.name;
  }
}

TEST_F(GaitClockTest, SwingShareGrowsFromNothingToOneAndStays) {
  begin(kTrot);
  double before = 0.0;
  until_first_swing_s();
  EXPECT_LT(clock_.swing_share(0), 0.02);
  for (int k = 0; k < 119; ++k) {
    clock_.advance(kGaitClockStep_s);
    EXPECT_GE(clock_.swing_share(0), before);
    before = clock_.swing_share(0);
  }
  EXPECT_GT(before, 0.98);
  for (int k = 0; k < 5; ++k) clock_.advance(kGaitClockStep_s);
  EXPECT_EQ(clock_.swing_share(0), 1.0);
  EXPECT_TRUE(clock_.swings(0)) << "only the foot itself says that it landed";
}

TEST_F(GaitClockTest, FrozenWhileNoTimePasses) {
  begin(kTrot);
  run(0.1);
  const double phase = clock_.phase();
  for (int k = 0; k < 100; ++k) clock_.advance(0.0);
  EXPECT_EQ(clock_.phase(), phase);
  EXPECT_TRUE(clock_.swings(0));
  EXPECT_FALSE(clock_.swings(1));
}

TEST_F(GaitClockTest, HeldNoFootBeginsToSwingButThoseInTheAirLand) {
  begin(kTrot);
  run(0.1);
  clock_.hold();
  EXPECT_TRUE(clock_.swings(0));
  run(0.25);
  EXPECT_TRUE(clock_.all_stand());
  run(5.0);
  EXPECT_TRUE(clock_.all_stand());
  EXPECT_GT(clock_.until_swing_s(0), 100.0);
}

TEST_F(GaitClockTest, ResumedItGoesOnWithTheNextTurn) {
  begin(kTrot);
  run(0.1);
  clock_.hold();
  run(1.0);
  clock_.resume();
  run(0.7);
  EXPECT_GE(clock_.rounds(), 1);
}

TEST_F(GaitClockTest, CountsDownToTheNextSwing) {
  begin(kTrot);
  const double until_s = clock_.until_swing_s(0);
  EXPECT_NEAR(until_s, 0.06, 1e-6);
  clock_.advance(kGaitClockStep_s);
  EXPECT_NEAR(clock_.until_swing_s(0), until_s - kGaitClockStep_s, 1e-9);
  EXPECT_NEAR(clock_.until_swing_s(1) - clock_.until_swing_s(0), 0.3, 1e-9);
}

TEST_F(GaitClockTest, FootThatLandedEarlySwingsNextInItsNextTurn) {
  begin(kTrot);
  until_first_swing_s();
  clock_.advance(kGaitClockStep_s);
  clock_.land(0);
  EXPECT_FALSE(clock_.swings(0));
  run(0.5);
  EXPECT_FALSE(clock_.swings(0));
  run(0.1);
  EXPECT_TRUE(clock_.swings(0));
}

TEST_F(GaitClockTest, StandingIsTheGaitWhoseLegsNeverSwing) {
  begin(gait(1.0, 1.0, {0, 0, 0, 0}));
  EXPECT_EQ(run(10.0), 0);
  EXPECT_EQ(clock_.rounds(), 0);
  EXPECT_GT(clock_.until_swing_s(2), 100.0);
}

}  // namespace
}  // namespace sprung
