#include "planner/gait/weight_shift.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

constexpr double kWeightShiftCycle_s = 0.002;

GaitConfig crawl(double sway_m = 0.1) {
  GaitConfig out;
  out.period_s = 3.6;
  out.duty = 0.8;
  out.offsets = {0.22, 0.72, 0.0, 0.5};
  out.sway_m = sway_m;
  return out;
}

/// A body over four feet, in the order fl, fr, hl, hr, that goes where it is told at once.
class WeightShiftTest : public testing::Test {
 protected:
  void begin(const GaitConfig& gait) {
    view_.carries.fill(true);
    gait_ = gait;
    clock_.begin(gait_, 4);
  }
  /// @param obeys the body follows the lean.
  void cycle(bool obeys = true) {
    const Eigen::Vector2d away_m = obeys ? shift_.at_m() : Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < 4; ++i) {
      const double x = i < 2 ? 0.22 : -0.22, y = i % 2 == 0 ? 0.15 : -0.15;
      view_.foot_m[i] = {x - away_m.x(), y - away_m.y(), -0.5};
    }
    shift_.step(clock_, view_, Eigen::Vector2d::Zero(), kWeightShiftCycle_s);
    clock_.advance(shift_.holds() ? 0.0 : kWeightShiftCycle_s);
  }
  bool any_swings() const { return !clock_.all_stand(); }

  GaitConfig gait_;
  GaitClock clock_;
  BodyView view_;
  WeightShift shift_{4};
};

TEST_F(WeightShiftTest, TheBodyLeansAwayFromTheLegThatIsToLeave) {
  begin(crawl());
  while (!any_swings()) cycle();
  EXPECT_TRUE(clock_.swings(2));
  EXPECT_GT(shift_.at_m().x(), 0.01);  // hind left: to the front and the right
  EXPECT_LT(shift_.at_m().y(), -0.01);
}

TEST_F(WeightShiftTest, ALegWaitsForABodyThatIsSlowAndLeavesWhenItIsThere) {
  begin(crawl());
  for (int k = 0; k < 750; ++k) cycle(false);
  EXPECT_TRUE(shift_.holds());
  EXPECT_FALSE(any_swings());
  cycle();  // there at last
  cycle();
  EXPECT_FALSE(shift_.holds());
  EXPECT_TRUE(any_swings());
  EXPECT_FALSE(shift_.gave_up());
}

TEST_F(WeightShiftTest, WhenNoLegIsToLeaveAnyMoreTheBodyComesBack) {
  begin(crawl());
  while (!any_swings()) cycle();
  EXPECT_GT(shift_.at_m().norm(), 0.02);
  EXPECT_FALSE(shift_.upright());
  clock_.land(2);
  clock_.hold();
  for (int k = 0; k < 1500; ++k) cycle();
  EXPECT_LT(shift_.at_m().norm(), 1e-3);
  EXPECT_TRUE(shift_.upright());
}

TEST_F(WeightShiftTest, ABodyThatIsToStayRestsWhereItLeans) {
  begin(crawl());
  while (!any_swings()) cycle();
  const Eigen::Vector2d there_m = shift_.at_m();
  clock_.land(2);
  clock_.hold();
  shift_.stay();
  for (int k = 0; k < 1500; ++k) cycle();
  EXPECT_LT((shift_.at_m() - there_m).norm(), 0.03);
  EXPECT_FALSE(shift_.upright());
  EXPECT_TRUE(shift_.rests());
  shift_.move();
  for (int k = 0; k < 150; ++k) cycle();
  EXPECT_FALSE(shift_.rests());
  for (int k = 0; k < 1500; ++k) cycle();
  EXPECT_TRUE(shift_.upright());
}

TEST_F(WeightShiftTest, ABodyThatDoesNotFollowIsWaitedForAndThenGivenUp) {
  begin(crawl());
  int cycles = 0;
  for (; !shift_.gave_up() && cycles < 5000; ++cycles) cycle(false);
  EXPECT_FALSE(any_swings());
  EXPECT_GT(cycles * kWeightShiftCycle_s, WeightShift::kGiveUp_s);
  EXPECT_LT(cycles * kWeightShiftCycle_s, WeightShift::kGiveUp_s + 1.0);
  shift_.begin(Eigen::Vector2d::Zero());
  EXPECT_FALSE(shift_.gave_up());
}

TEST_F(WeightShiftTest, ABodyThatMovesTheWrongWayIsNotSafeWhereItIs) {
  begin(crawl());
  while (!any_swings()) cycle();
  const Eigen::Vector2d there_m = shift_.at_m();
  for (const double speed_m_s : {0.0, 0.5}) {
    WeightShift other(4);
    GaitClock clock;
    clock.begin(gait_, 4);
    while (clock.until_swing_s(2) > 1.5 * kWeightShiftCycle_s) clock.advance(kWeightShiftCycle_s);
    BodyView view = view_;
    for (std::size_t i = 0; i < 4; ++i)
      view.foot_m[i] = {(i < 2 ? 0.22 : -0.22) - there_m.x(), (i % 2 == 0 ? 0.15 : -0.15) - there_m.y(),
                        -0.5};
    view.velocity_known = true;
    view.velocity_m_s = {0.0, speed_m_s, 0.0};
    other.step(clock, view, Eigen::Vector2d::Zero(), kWeightShiftCycle_s);
    EXPECT_EQ(other.holds(), speed_m_s > 0.0);
  }
}

TEST_F(WeightShiftTest, AFootThatNobodyKnowsKeepsTheLegDownAndTheLeanFinite) {
  begin(crawl());
  for (int k = 0; k < 750; ++k) cycle(false);
  view_.foot_m[0].setConstant(kNaN);
  for (int k = 0; k < 10; ++k) {
    shift_.step(clock_, view_, Eigen::Vector2d::Zero(), kWeightShiftCycle_s);
    EXPECT_TRUE(shift_.holds());
    EXPECT_TRUE(shift_.at_m().allFinite());
  }
}

TEST_F(WeightShiftTest, NoFartherThanTheGaitsSwayAndHalfAsMuchAgainWhereItWaits) {
  begin(crawl(0.03));
  bool waited = false;
  for (int k = 0; k < 1500; ++k) {
    cycle(false);
    waited = waited || shift_.holds();
    EXPECT_LE(shift_.at_m().norm(), (waited ? 1.5 : 1.0) * 0.03 + 1e-9) << k;
  }
  EXPECT_TRUE(waited);
  EXPECT_GT(shift_.at_m().norm(), 1.2 * 0.03);
}

TEST_F(WeightShiftTest, GaitsWithoutSwayNeitherLeanNorWait) {
  begin(crawl(0.0));
  for (int k = 0; k < 3000; ++k) {
    cycle();
    ASSERT_FALSE(shift_.holds());
    ASSERT_TRUE(shift_.at_m().isZero());
    for (std::size_t i = 0; i < 4; ++i)
      if (clock_.swings(i) && clock_.swing_share(i) >= 1.0) clock_.land(i);
  }
}

TEST_F(WeightShiftTest, WhoIsCarefulWaitsForFeetThatAreFeltToCarryButNotForLong) {
  for (const bool careful : {false, true}) {
    begin(crawl());
    shift_.begin(Eigen::Vector2d::Zero());
    shift_.be_careful(careful);
    view_.carries[1] = false;
    double waited_s = 0.0;
    for (int k = 0; k < 3000 && !any_swings(); ++k) {
      cycle();
      if (shift_.holds()) waited_s += kWeightShiftCycle_s;
    }
    EXPECT_TRUE(any_swings());
    EXPECT_NEAR(waited_s, careful ? 0.3 : 0.0, 0.01);
  }
}

TEST_F(WeightShiftTest, TheWeightIsFartherFromAFootThatCarriesNothingWhichWhoIsCarefulMinds) {
  begin(crawl());
  while (!any_swings()) cycle();
  view_.carries[1] = false;  // front right
  for (int k = 0; k < 150; ++k) cycle();
  view_.carries[1] = true;
  for (int k = 0; k < 100; ++k) cycle();
  const Eigen::Vector2d careless_m = shift_.at_m();
  shift_.be_careful(true);
  for (int k = 0; k < 100; ++k) cycle();
  const Eigen::Vector2d more_m = shift_.at_m() - careless_m;
  EXPECT_GT(more_m.dot(Eigen::Vector2d(0.22, -0.15).normalized()), 0.005) << "toward that foot";
  EXPECT_LT(more_m.norm(), 0.035);
}

}  // namespace
}  // namespace sprung
