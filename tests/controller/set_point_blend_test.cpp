#include "controller/set_point_blend.h"

#include <gtest/gtest.h>

#include "robots/robot_loader.h"
#include "tests/support/allocation_count.h"

namespace sprung {
namespace {

constexpr double kSetPointBlendCycle_s = 0.001;

class SetPointBlendTest : public testing::Test {
 protected:
  static JointVector pair(double a, double b) {
    JointVector v(2);
    v << a, b;
    return v;
  }
  /// What the drive's position loop gives at a leg that rests at zero.
  double loop_Nm(const SetPoints& to, int i) const {
    const ActuatorConfig& a = actuators_[i];
    return a.position_stiffness_Nm_rad * to.position_rad[i] +
           a.position_damping_Nm_s_rad * to.velocity_rad_s[i];
  }
  SetPoints motion(const SetPoints& to) const {
    SetPoints out = to;
    blend_.add_motion(out);
    return out;
  }
  SetPoints torque() const {
    SetPoints out = rest_;
    blend_.add_torque(out);
    return out;
  }

  std::vector<ActuatorConfig> actuators_ = load_robot("single_leg").actuators;
  SetPointBlend blend_{actuators_};
  SetPoints rest_{pair(0, 0), pair(0, 0)};
};

TEST_F(SetPointBlendTest, BeforeTheFirstStartNothingIsAdded) {
  EXPECT_EQ(motion(rest_).position_rad, rest_.position_rad);
  EXPECT_EQ(torque().velocity_rad_s, rest_.velocity_rad_s);
}

TEST_F(SetPointBlendTest, MotionBeginsWithOldPositionAndSpeedAndEndsWithTheNew) {
  const SetPoints from{pair(0.1, -0.3), pair(2.0, -5.0)};
  const SetPoints to{pair(0.2, 0.1), pair(0.0, 1.0)};
  blend_.start_motion(from, to);
  EXPECT_LT((motion(to).position_rad - from.position_rad).norm(), 1e-12);
  EXPECT_LT((motion(to).velocity_rad_s - from.velocity_rad_s).norm(), 1e-12);
  for (int k = 0; k < 400; ++k) blend_.advance(kSetPointBlendCycle_s);
  EXPECT_LT((motion(to).position_rad - to.position_rad).norm(), 1e-12);
  EXPECT_LT((motion(to).velocity_rad_s - to.velocity_rad_s).norm(), 1e-12);
}

TEST_F(SetPointBlendTest, SpeedIsTheDerivativeOfThePositionAndItsChangeIsBounded) {
  blend_.start_motion({pair(0.1, -0.05), pair(2.0, -3.0)}, rest_);
  SetPoints before = motion(rest_);
  for (int k = 0; k < 300; ++k) {
    blend_.advance(kSetPointBlendCycle_s);
    const SetPoints now = motion(rest_);
    const JointVector mean = 0.5 * (now.velocity_rad_s + before.velocity_rad_s);
    const JointVector moved = (now.position_rad - before.position_rad) / kSetPointBlendCycle_s;
    ASSERT_LT((moved - mean).cwiseAbs().maxCoeff(), 1e-2);
    ASSERT_LT((now.velocity_rad_s - before.velocity_rad_s).cwiseAbs().maxCoeff(), 0.201);  // position + speed
    before = now;
  }
}

TEST_F(SetPointBlendTest, LoopGivesTheOldTorqueFromTheFirstCycleOnAndItFadesWithoutAStep) {
  blend_.start_torque(pair(20.0, -140.0), kSetPointBlendCycle_s);
  EXPECT_NEAR(loop_Nm(torque(), 0), 20.0, 1e-9);
  EXPECT_NEAR(loop_Nm(torque(), 1), -140.0, 1e-9);
  double before_Nm = -140.0;
  for (int k = 0; k < 200; ++k) {
    blend_.advance(kSetPointBlendCycle_s);
    const double now_Nm = loop_Nm(torque(), 1);
    ASSERT_LT(std::abs(now_Nm - before_Nm), 0.021 * actuators_[1].torque_limit_Nm);
    ASSERT_GE(now_Nm, before_Nm - 1e-9);
    before_Nm = now_Nm;
  }
  EXPECT_NEAR(before_Nm, 0.0, 1e-6);
  EXPECT_LT(std::abs(torque().position_rad[0]), 0.1 * 20.0 / actuators_[0].position_stiffness_Nm_rad);
}

TEST_F(SetPointBlendTest, SmallDisplacementsAreEnoughBecauseTheRateDoesTheWork) {
  blend_.start_torque(pair(171.6, 20.0), kSetPointBlendCycle_s);
  double farthest_rad = 0.0;
  for (int k = 0; k < 200; ++k) {
    blend_.advance(kSetPointBlendCycle_s);
    farthest_rad = std::max(farthest_rad, torque().position_rad.cwiseAbs().maxCoeff());
  }
  EXPECT_LT(farthest_rad, 0.17);  // 171.6 Nm / 503 Nm/rad would be 0.34
}

TEST_F(SetPointBlendTest, UnknownStiffnessGetsNoTorqueAndALoopWithoutDampingADisplacement) {
  actuators_[0].position_stiffness_Nm_rad = 0.0;
  actuators_[1].position_damping_Nm_s_rad = 0.0;
  SetPointBlend blend(actuators_);
  blend.start_torque(pair(20.0, 20.0), kSetPointBlendCycle_s);
  SetPoints out = rest_;
  blend.add_torque(out);
  EXPECT_EQ(out.position_rad[0], 0.0);
  EXPECT_EQ(out.velocity_rad_s[0], 0.0);
  EXPECT_NEAR(out.position_rad[1], 20.0 / 503.0, 1e-12);
}

TEST_F(SetPointBlendTest, LoopGivesTheTorqueThatIsFedForwardAsTheOldOneGoes) {
  blend_.feed_forward(pair(30.0, -50.0));
  blend_.start_torque(pair(10.0, 20.0), kSetPointBlendCycle_s);
  EXPECT_NEAR(loop_Nm(torque(), 0), 10.0, 1e-9);
  EXPECT_NEAR(loop_Nm(torque(), 1), 20.0, 1e-9);
  for (int k = 0; k < 100; ++k) blend_.advance(kSetPointBlendCycle_s);
  for (const double torque_Nm : {-50.0, 12.0, 80.0}) {  // followed from cycle to cycle
    blend_.feed_forward(pair(30.0, torque_Nm));
    double before_Nm = loop_Nm(torque(), 1);
    for (int k = 0; k < 50; ++k) {  // no faster than an old torque goes
      blend_.advance(kSetPointBlendCycle_s);
      ASSERT_LT(std::abs(loop_Nm(torque(), 1) - before_Nm), 0.0211 * actuators_[1].torque_limit_Nm);
      before_Nm = loop_Nm(torque(), 1);
    }
    EXPECT_NEAR(loop_Nm(torque(), 0), 30.0, 1e-9);
    EXPECT_NEAR(loop_Nm(torque(), 1), torque_Nm, 1e-9);
  }
}

TEST_F(SetPointBlendTest, FeedForwardStaysWithinTheMotorsLimits) {
  blend_.feed_forward(pair(1e4, -1e4));
  for (int k = 0; k < 100; ++k) blend_.advance(kSetPointBlendCycle_s);
  EXPECT_NEAR(loop_Nm(torque(), 0), actuators_[0].torque_limit_Nm, 1e-6);
  EXPECT_NEAR(loop_Nm(torque(), 1), -actuators_[1].torque_limit_Nm, 1e-6);
}

TEST_F(SetPointBlendTest, NothingIsAllocated) {
  const std::int64_t before = test::allocation_count();
  blend_.start_motion({pair(0.1, -0.05), pair(2.0, -3.0)}, rest_);
  blend_.start_torque(pair(20.0, -14.0), kSetPointBlendCycle_s);
  for (int k = 0; k < 10; ++k) blend_.advance(kSetPointBlendCycle_s);
  EXPECT_EQ(test::allocation_count(), before);
  EXPECT_GT(torque().position_rad.norm(), 0.0);
}

}  // namespace
}  // namespace sprung
