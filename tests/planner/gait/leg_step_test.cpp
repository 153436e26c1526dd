#include "planner/gait/leg_step.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace sprung {
namespace {

constexpr double kGround_m = -0.5;
const Eigen::Vector3d kPlace_m(0.33, 0.2, kGround_m);

/// One leg whose foot is where it is wanted, unless the floor is in its way.
class LegStepTest : public testing::Test {
 protected:
  LegStepTest() {
    gait_.period_s = 0.6;
    gait_.duty = 0.6;
    gait_.lift_m = 0.05;
    gait_.pre_stance = 0.3;
    law_.approach_m_s = 0.2;
    law_.step_down_m = 0.04;
    plan_.gait = &gait_;
    plan_.law = &law_;
    plan_.dt_s = 0.002;
    plan_.swing_s = 0.24;
    plan_.body_m_s = {0.3, 0.0, 0.0};
    leg_.stand(kPlace_m);
  }
  void lift(GaitControl control = GaitControl::kAdaptive) {
    plan_.control = control;
    leg_.lift(foot_m_);
    swing_s_ = 0.0;
  }
  bool cycle() {
    const bool landed = leg_.step(plan_, foot_m_, foothold_m_, contact_ || touches());
    swing_s_ += plan_.dt_s;
    foot_m_ = leg_.wanted_m();
    foot_m_.z() = std::max(foot_m_.z(), floor_m_);
    return landed;
  }
  /// Until it lands. @return share of the swing then.
  double land() {
    for (int k = 0; k < 1000; ++k)
      if (cycle()) return swing_s_ / plan_.swing_s;
    ADD_FAILURE() << "never landed";
    return 0.0;
  }
  void swing_to(double share) {
    while (swing_s_ < share * plan_.swing_s - 1e-9) cycle();
  }
  bool touches() const { return swing_s_ > 0.02 && foot_m_.z() <= floor_m_ + 1e-9; }
  std::int32_t count(LegEvent event) const { return leg_.counts()[static_cast<std::size_t>(event)]; }
  int events() const {
    int sum = 0;
    for (const std::int32_t n : leg_.counts()) sum += n;
    return sum;
  }

  GaitConfig gait_;
  WalkConfig law_;
  StepPlan plan_;
  LegStep leg_;
  Eigen::Vector3d foot_m_ = kPlace_m;
  Eigen::Vector3d foothold_m_ = kPlace_m + Eigen::Vector3d(0.05, 0.0, 0.0);
  double floor_m_ = kGround_m;
  double swing_s_ = 0.0;
  bool contact_ = false;
};

TEST_F(LegStepTest, StandingFootIsCarriedAlongAsTheBodyMovesOverIt) {
  plan_.turning_rad_s = 0.5;
  cycle();
  const Eigen::Vector3d expected_m_s(-0.3 + 0.5 * kPlace_m.y(), -0.5 * kPlace_m.x(), 0.0);
  EXPECT_TRUE(leg_.wanted_m_s().isApprox(expected_m_s, 1e-12));
  EXPECT_TRUE(leg_.wanted_m().isApprox(kPlace_m + 0.002 * expected_m_s, 1e-12));
  EXPECT_NEAR(leg_.in_phase_s(), 0.002, 1e-15);
}

TEST_F(LegStepTest, StandingFootRollsAfterTheBodyByItsShareOfTheHipsHeight) {
  plan_.foot_radius_m = 0.02;
  cycle();
  const double height_m = -kPlace_m.z();
  EXPECT_NEAR(leg_.wanted_m_s().x(), -0.3 * height_m / (height_m + 0.02), 1e-12);
  EXPECT_EQ(leg_.wanted_m_s().z(), 0.0);
}

TEST_F(LegStepTest, FootThatStoodBeforeSaysSinceWhen) {
  leg_.stand(kPlace_m, 0.1);
  cycle();
  EXPECT_NEAR(leg_.in_phase_s(), 0.102, 1e-15);
}

TEST_F(LegStepTest, PhasesFollowEachOther) {
  lift();
  EXPECT_EQ(leg_.phase(), LegPhase::kSwing);
  swing_to(0.68);
  EXPECT_EQ(leg_.phase(), LegPhase::kSwing);
  swing_to(0.72);
  EXPECT_EQ(leg_.phase(), LegPhase::kPreStance);
  EXPECT_LT(leg_.in_phase_s(), 0.02);
  EXPECT_NEAR(land(), 1.0, 0.02);
  EXPECT_EQ(leg_.phase(), LegPhase::kStance);
  EXPECT_TRUE(leg_.stands());
  EXPECT_EQ(events(), 0);
}

TEST_F(LegStepTest, FootLandsWhereItIsAndAtItsFoothold) {
  lift();
  land();
  EXPECT_NEAR((leg_.wanted_m() - foothold_m_).head<2>().norm(), 0.0, 3e-3);
  EXPECT_NEAR(leg_.wanted_m().z(), kGround_m, 1e-3);
}

TEST_F(LegStepTest, EveryControlLandsOnFlatGroundWithoutAnEvent) {
  for (const GaitControl control : {GaitControl::kAdaptive, GaitControl::kHybrid}) {
    lift(control);
    EXPECT_NEAR(land(), 1.0, 0.03);
    EXPECT_EQ(events(), 0) << name(control);
    foothold_m_ = foot_m_;
  }
}

TEST_F(LegStepTest, HigherGroundIsEarlyContactAndEndsTheSwing) {
  lift();
  floor_m_ = kGround_m + 0.012;
  EXPECT_LT(land(), 0.85);
  EXPECT_EQ(count(LegEvent::kEarlyContact), 1);
  EXPECT_EQ(leg_.last_event(), LegEvent::kEarlyContact);
  EXPECT_EQ(events(), 1);
  EXPECT_NEAR(leg_.wanted_m().z(), floor_m_, 1e-3);
}

TEST_F(LegStepTest, LowerGroundIsLateContactAndTheFootStepsDownToIt) {
  for (const GaitControl control : {GaitControl::kAdaptive, GaitControl::kForce, GaitControl::kPreStance}) {
    const int before = count(LegEvent::kLateContact);
    foot_m_ = kPlace_m;
    lift(control);
    floor_m_ = kGround_m - 0.02;
    EXPECT_NEAR(land(), 1.0 + 0.1 / 0.24, 0.03) << name(control);
    EXPECT_EQ(count(LegEvent::kLateContact), before + 1);
    EXPECT_EQ(count(LegEvent::kNoGround), 0);
    EXPECT_FALSE(leg_.gave_up());
    EXPECT_NEAR(leg_.wanted_m().z(), floor_m_, 1e-3);
  }
}

TEST_F(LegStepTest, LateWhileItLooksForTheGround) {
  lift();
  floor_m_ = kGround_m - 0.02;
  swing_to(0.9);
  EXPECT_FALSE(leg_.late(plan_));
  swing_to(1.1);
  EXPECT_TRUE(leg_.late(plan_));
  EXPECT_NEAR(leg_.wanted_m_s().z(), -law_.approach_m_s, 1e-12);
  land();
  EXPECT_FALSE(leg_.late(plan_));
}

TEST_F(LegStepTest, RemembersWhatItsSpringLaggedByWhenItLeft) {
  leg_.shift({-0.03, 0.01, 0.0});
  lift();
  EXPECT_NEAR(leg_.stretch_at_lift_m().x(), -0.03, 1e-12);
  EXPECT_NEAR(leg_.stretch_at_lift_m().y(), 0.01, 1e-12);
}

TEST_F(LegStepTest, ComesDownAtTheGaitsOwnSpeedWhereItHasOne) {
  gait_.approach_m_s = 0.3;
  lift();
  floor_m_ = kGround_m - 0.02;
  swing_to(0.95);
  EXPECT_NEAR(leg_.wanted_m_s().z(), -0.3, 1e-12);
  swing_to(1.1);
  EXPECT_NEAR(leg_.wanted_m_s().z(), -0.3, 1e-12);
}

TEST_F(LegStepTest, WithoutGroundItGivesUpAtTheLimitOfSteppingDown) {
  for (const GaitControl control : {GaitControl::kAdaptive, GaitControl::kForce, GaitControl::kPreStance}) {
    foot_m_ = kPlace_m;
    lift(control);
    floor_m_ = -9.0;
    EXPECT_NEAR(land(), 1.0 + law_.step_down_m / law_.approach_m_s / 0.24, 0.03);
    EXPECT_TRUE(leg_.gave_up());
    EXPECT_EQ(leg_.last_event(), LegEvent::kNoGround);
    EXPECT_NEAR(leg_.wanted_m().z(), kGround_m - law_.step_down_m, 2e-3);
    lift();
    EXPECT_FALSE(leg_.gave_up());
  }
  EXPECT_EQ(count(LegEvent::kNoGround), 3);
}

/// A leg that reaches ahead is too short for what is further down.
TEST_F(LegStepTest, LateFootSearchesDownAndBackToUnderItsHip) {
  plan_.body_m_s.setZero();
  plan_.ahead_m = {0.015, -0.02};
  law_.step_down_m = 0.06;
  floor_m_ = -9.0;
  lift();
  swing_to(1.0);
  const Eigen::Vector3d before_m = leg_.wanted_m();
  swing_to(1.0 + 0.01 / law_.approach_m_s / plan_.swing_s);
  EXPECT_NEAR(before_m.z() - leg_.wanted_m().z(), 0.01, 5e-4);
  EXPECT_TRUE((before_m - leg_.wanted_m()).head<2>().isApprox(Eigen::Vector2d(0.006, -0.008), 0.05));
  EXPECT_TRUE(leg_.wanted_m_s().head<2>().isApprox(Eigen::Vector2d(-0.12, 0.16), 1e-9));
  land();
  EXPECT_TRUE((before_m - leg_.wanted_m()).head<2>().isApprox(plan_.ahead_m, 1e-9));
  EXPECT_EQ(leg_.wanted_m_s().head<2>().norm(), 0.0);
}

TEST_F(LegStepTest, PlainHybridTrustsItsClockWhateverTheGroundDoes) {
  floor_m_ = -9.0;
  lift(GaitControl::kHybrid);
  EXPECT_NEAR(land(), 1.0, 0.02);
  EXPECT_EQ(events(), 0);
  EXPECT_FALSE(leg_.gave_up());
}

TEST_F(LegStepTest, ContactWhileTheFootIsStillLeavingIsNothing) {
  contact_ = true;
  lift();
  swing_to(0.18);
  EXPECT_EQ(events(), 0);
  EXPECT_EQ(leg_.phase(), LegPhase::kSwing);
}

TEST_F(LegStepTest, ContactOnTheWayUpIsAStumbleAndLiftsTheFootHigherWithoutAJerk) {
  LegStep undisturbed = leg_;
  lift();
  undisturbed.lift(kPlace_m);
  double higher_m = 0.0;
  for (double share = 0.0; share < 0.55; share += plan_.dt_s / plan_.swing_s) {
    contact_ = share > 0.21 && share < 0.4;
    cycle();
    undisturbed.step(plan_, undisturbed.wanted_m(), foothold_m_, false);
    const double now_m = leg_.wanted_m().z() - undisturbed.wanted_m().z();
    EXPECT_GE(now_m, -1e-12);
    EXPECT_LT(now_m - higher_m, 0.5 * plan_.dt_s);
    higher_m = now_m;
  }
  EXPECT_GT(higher_m, 0.004);
  EXPECT_EQ(count(LegEvent::kStumble), 1);
  EXPECT_FALSE(leg_.stands());
}

TEST_F(LegStepTest, ContactThatPassesInTenMillisecondsIsWhatAQuickSwingFeigns) {
  lift();
  swing_to(0.3);
  contact_ = true;
  for (int k = 0; k < 5; ++k) cycle();
  contact_ = false;
  swing_to(0.55);
  EXPECT_EQ(events(), 0);
}

TEST_F(LegStepTest, EverySwingThatStumblesIsCounted) {
  for (int swing = 1; swing <= 3; ++swing) {
    lift();
    swing_to(0.3);
    contact_ = true;
    swing_to(0.5);
    contact_ = false;
    land();
    EXPECT_EQ(count(LegEvent::kStumble), swing);
  }
}

TEST_F(LegStepTest, OtherControlWaitsForTheNextSwing) {
  lift(GaitControl::kAdaptive);
  Eigen::Vector3d before_m = foot_m_;
  for (double share = 0.0; share < 0.9; share += plan_.dt_s / plan_.swing_s) {
    if (share > 0.5) plan_.control = GaitControl::kHybrid;
    cycle();
    EXPECT_LT((leg_.wanted_m() - before_m - plan_.dt_s * leg_.wanted_m_s()).norm(), 1e-3) << share;
    before_m = leg_.wanted_m();
  }
  EXPECT_EQ(leg_.control(), GaitControl::kAdaptive);
  land();
  lift(GaitControl::kHybrid);
  cycle();
  EXPECT_EQ(leg_.control(), GaitControl::kHybrid);
}

TEST_F(LegStepTest, WantedVelocityIsTheChangeOfTheWantedPlaceFromLiftToStance) {
  for (const GaitControl control :
       {GaitControl::kAdaptive, GaitControl::kForce, GaitControl::kHybrid, GaitControl::kPreStance}) {
    floor_m_ = control == GaitControl::kHybrid ? kGround_m : kGround_m - 0.02;
    lift(control);
    Eigen::Vector3d before_m = foot_m_;
    bool landed = false;
    for (int k = 0; k < 1000 && !landed; ++k) {
      landed = cycle();
      EXPECT_LT((leg_.wanted_m() - before_m - plan_.dt_s * leg_.wanted_m_s()).norm(), 1.2e-3)
          << name(control) << " " << swing_s_;
      before_m = leg_.wanted_m();
    }
    foot_m_ = kPlace_m;
  }
}

TEST_F(LegStepTest, EventsAreForgottenButStayCounted) {
  leg_.note(LegEvent::kSlip);
  EXPECT_EQ(leg_.last_event(), LegEvent::kSlip);
  leg_.forget_event();
  EXPECT_EQ(leg_.last_event(), LegEvent::kNone);
  EXPECT_EQ(count(LegEvent::kSlip), 1);
}

TEST_F(LegStepTest, WhatOtherFeetLearnOfTheGroundDoesNotJerkASwing) {
  lift();
  swing_to(0.5);
  LegStep undisturbed = leg_;
  undisturbed.step(plan_, foot_m_, foothold_m_, false);
  foothold_m_.z() += 0.01;
  cycle();
  EXPECT_EQ(leg_.wanted_m(), undisturbed.wanted_m());
}

TEST_F(LegStepTest, TrunkThatSinksUnderASwingLeavesItsPathOverTheGround) {
  lift();
  swing_to(0.5);
  LegStep level = leg_;
  level.step(plan_, foot_m_, foothold_m_, false);
  plan_.sunk_m = 0.001;
  cycle();
  EXPECT_NEAR(leg_.wanted_m().z() - level.wanted_m().z(), 0.001, 1e-12);
  EXPECT_NEAR((leg_.wanted_m() - level.wanted_m()).head<2>().norm(), 0.0, 1e-12);
}

/// A stair of 80 mm, 60 mm ahead: the foot is where it is wanted but for that.
class LegStepAtAStair : public LegStepTest {
 protected:
  LegStepAtAStair() {
    plan_.may_wait = true;
    plan_.swing_s = 0.6;
    plan_.body_m_s.setZero();
    gait_.pre_stance = 0.13;
    foothold_m_ = kPlace_m + Eigen::Vector3d(0.15, 0.0, 0.0);
  }
  bool climb() {
    const bool landed = leg_.step(plan_, foot_m_, foothold_m_, contact_ || on_ground_);
    Eigen::Vector3d to_m = leg_.wanted_m();
    if (foot_m_.x() <= kRiser_m && to_m.z() < kStair_m) to_m.x() = std::min(to_m.x(), kRiser_m);
    const double floor_m = to_m.x() > kRiser_m ? kStair_m : kGround_m;
    on_ground_ = to_m.z() <= floor_m;
    to_m.z() = std::max(to_m.z(), floor_m);
    foot_m_ = to_m;
    return landed;
  }
  bool lands(int cycles = 2000) {
    for (int k = 0; k < cycles; ++k)
      if (climb()) return true;
    return false;
  }

  static constexpr double kStair_m = kGround_m + 0.08;
  const double kRiser_m = kPlace_m.x() + 0.06;
  bool on_ground_ = false;
};

TEST_F(LegStepAtAStair, FootThatIsHeldUpBeginsAnewAndStandsOnTheStair) {
  lift();
  ASSERT_TRUE(lands());
  EXPECT_NEAR(foot_m_.z(), kStair_m, 0.005);
  EXPECT_GT(foot_m_.x(), kRiser_m + 0.06);
  EXPECT_GE(count(LegEvent::kStumble), 1);
  EXPECT_FALSE(leg_.gave_up());
}

TEST_F(LegStepAtAStair, WhereNobodyWaitsItDoesNot) {
  plan_.may_wait = false;
  lift();
  ASSERT_TRUE(lands());
  EXPECT_NEAR(foot_m_.z(), kGround_m, 0.005);
}

TEST_F(LegStepAtAStair, ItsSwingIsYoungerThanTheClocks) {
  lift();
  double age_s = 0.0;
  for (; !leg_.held_up() && age_s < 1.0; age_s += plan_.dt_s) climb();
  ASSERT_TRUE(leg_.held_up());
  EXPECT_TRUE(leg_.behind(age_s));
  EXPECT_FALSE(leg_.behind(plan_.dt_s));
}

}  // namespace
}  // namespace sprung
