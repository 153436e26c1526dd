#include "planner/gait/heat_lean.h"

#include <gtest/gtest.h>

#include <array>

namespace sprung {
namespace {

constexpr double kHeatCycle_s = 0.002;

/// Four legs in the order fl, fr, hl, hr, three joints each. @param ahead_m of the trunk's origin.
BodyShape shape(double ahead_m = 0.0) {
  RobotConfig robot;
  for (std::size_t i = 0; i < 4; ++i) {
    LegConfig leg;
    leg.hip_in_trunk_m = {ahead_m + (i < 2 ? 0.33 : -0.33), i % 2 == 0 ? 0.2 : -0.2, 0.0};
    leg.joints = {static_cast<int>(3 * i), static_cast<int>(3 * i) + 1, static_cast<int>(3 * i) + 2};
    leg.links.resize(3);
    robot.legs.push_back(leg);
  }
  return BodyShape(robot);
}

/// All cold but one joint of each leg.
JointState knees_at(const std::array<double, 4>& warmth) {
  JointState state(12, 4);
  for (EstimatedJoint& joint : state.joints) joint.winding_share = 0.1;
  for (std::size_t i = 0; i < 4; ++i) state.joints[3 * i + 2].winding_share = warmth[i];
  return state;
}

class HeatLeanTest : public testing::Test {
 protected:
  const Eigen::Vector2d& after(double duration_s, const std::array<double, 4>& warmth, bool leads = true) {
    const JointState state = knees_at(warmth);
    for (int k = 0; k < static_cast<int>(duration_s / kHeatCycle_s); ++k)
      lean_.step(state, shape_, leads, kHeatCycle_s);
    return lean_.at_m();
  }
  const BodyShape shape_ = shape();
  HeatLean lean_;
};

TEST_F(HeatLeanTest, CoolLegsLeaveTheBodyWhereItIs) {
  EXPECT_EQ(after(60.0, {0.1, 0.2, 0.3, HeatLean::kFrom}).norm(), 0.0);
}

TEST_F(HeatLeanTest, TheBodyGoesAwayFromTheWarmestLeg) {
  const Eigen::Vector2d at_m = after(60.0, {0.3, 0.3, 0.9, 0.3});  // hind left
  EXPECT_NEAR(at_m.norm(), HeatLean::kMost_m, 1e-12);
  EXPECT_GT(at_m.x(), 0.0);
  EXPECT_LT(at_m.y(), 0.0);
}

TEST_F(HeatLeanTest, TwoWarmHindLegsSendItForwardAndNoFurther) {
  const Eigen::Vector2d at_m = after(60.0, {0.3, 0.3, 0.9, 0.9});
  EXPECT_NEAR(at_m.x(), HeatLean::kMost_m, 1e-12);
  EXPECT_NEAR(at_m.y(), 0.0, 1e-12);
}

TEST_F(HeatLeanTest, LegsThatAreAllWarmLeaveItInTheMiddle) {
  EXPECT_NEAR(after(60.0, {0.9, 0.9, 0.9, 0.9}).norm(), 0.0, 1e-12);
}

TEST_F(HeatLeanTest, TheMiddleIsThatOfTheFeetWhereverTheTrunksOriginIs) {
  const BodyShape behind = shape(-0.5);
  for (int k = 0; k < 30000; ++k) lean_.step(knees_at({0.9, 0.9, 0.9, 0.9}), behind, true, kHeatCycle_s);
  EXPECT_NEAR(lean_.at_m().norm(), 0.0, 1e-12);
}

TEST_F(HeatLeanTest, GoesFurtherTheWarmerTheLegIs) {
  const double half = after(60.0, {0.1, 0.1, 0.6, 0.1}).norm();
  EXPECT_NEAR(half, 0.5 * HeatLean::kMost_m, 1e-9);
}

TEST_F(HeatLeanTest, GoesSlowlyAndComesBackToStandInTime) {
  EXPECT_NEAR(after(1.0, {0.3, 0.3, 0.9, 0.3}).norm(), 0.005, 1e-5);
  after(60.0, {0.3, 0.3, 0.9, 0.3});
  EXPECT_EQ(after(0.3, {0.3, 0.3, 0.9, 0.3}, false).norm(), 0.0);
}

TEST_F(HeatLeanTest, MotorsOfWhichNothingIsKnownAreCold) {
  EXPECT_EQ(after(1.0, {kNaN, kNaN, kNaN, kNaN}).norm(), 0.0);
}

TEST_F(HeatLeanTest, ForgetsWhenAWalkBegins) {
  after(60.0, {0.3, 0.3, 0.9, 0.3});
  lean_.reset();
  EXPECT_EQ(lean_.at_m().norm(), 0.0);
}

}  // namespace
}  // namespace sprung
