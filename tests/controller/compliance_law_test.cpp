#include "controller/compliance_law.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "model/two_link.h"
#include "robots/robot_loader.h"

namespace sprung {
namespace {

class ComplianceLawTest : public testing::Test {
 protected:
  ComplianceLawTest() {
    desired_.stiffness_N_m = {2000.0, 0.0, 1500.0};
    desired_.damping_N_s_m = {40.0, 0.0, 60.0};
    measured_.position_rad = pair(2.3, 1.4);
    measured_.velocity_rad_s = pair(0.0, 0.0);
    measured_.temperature_C = pair(kNaN, kNaN);
    foot_ = {leg_.foot_in_hip_m(measured_.position_rad), Eigen::Vector3d::Zero()};
  }
  static JointVector pair(double a, double b) {
    JointVector v(2);
    v << a, b;
    return v;
  }
  static FrictionParameters coulomb(double torque_Nm) {
    FrictionParameters p;
    p.coulomb_Nm = torque_Nm;
    return p;
  }
  JointVector torque() const {
    return compliance_torque(leg_, desired_, foot_, measured_, joints_).torque_Nm;
  }
  PosedLeg at() const { return posed(leg_, measured_.position_rad); }
  /// Force that the leg puts on the world at its foot.
  Eigen::Vector3d force() const {
    const JointVector motion = torque() - leg_.gravity_torque_Nm(measured_.position_rad);
    return damped_inverse(leg_.jacobian(measured_.position_rad)).matrix * motion;
  }

  TwoLink leg_{load_robot("single_leg").legs[0]};
  DesiredLeg desired_;
  FootMotion foot_;
  LegMotion measured_;
  JointCompensation joints_{{coulomb(1.79), coulomb(1.79)}, 0.05, {}, {}, {}};
};

TEST_F(ComplianceLawTest, AtTheTargetOnlyTheLegsOwnWeightIsHeld) {
  EXPECT_LT((torque() - leg_.gravity_torque_Nm(measured_.position_rad)).norm(), 1e-12);
}

TEST_F(ComplianceLawTest, ActsAsASpringTowardTheTarget) {
  foot_.position_m += Eigen::Vector3d(0.01, 0.0, -0.02);
  EXPECT_LT((force() - Eigen::Vector3d(20.0, 0.0, -30.0)).norm(), 1e-9);
}

TEST_F(ComplianceLawTest, DampingTakesEnergyOutWhateverTheMotion) {
  desired_.friction_compensation = 0.0;
  std::mt19937 random(5);
  std::uniform_real_distribution<double> rate(-10.0, 10.0);
  for (int i = 0; i < 200; ++i) {  // errata E2
    measured_.velocity_rad_s = pair(rate(random), rate(random));
    const JointVector motion = torque() - leg_.gravity_torque_Nm(measured_.position_rad);
    EXPECT_LT(motion.dot(measured_.velocity_rad_s), 0.0);
  }
}

TEST_F(ComplianceLawTest, ShareOfTheDesiredVelocityIsFedForward) {
  desired_.velocity_feedforward = 0.5;
  foot_.velocity_m_s = {0.0, 0.0, -2.0};
  EXPECT_NEAR(force().z(), 60.0 * 0.5 * -2.0, 1e-9);
}

TEST_F(ComplianceLawTest, FeedForwardIsTheGroundsForceOnTheFoot) {
  desired_.feedforward_force_N = {0.0, 0.0, 51.0};  // to be carried: the leg must push down
  EXPECT_NEAR(force().z(), -51.0, 1e-9);
}

TEST_F(ComplianceLawTest, FrictionIsCompensatedWithTheMeasuredSpeedAndNotAtRest) {
  desired_.friction_compensation = 0.8;
  desired_.damping_N_s_m = {0.0, 0.0, 0.0};
  const JointVector at_rest = torque();
  measured_.velocity_rad_s = pair(5.0, -5.0);
  const JointVector moving = torque() - at_rest;
  EXPECT_NEAR(moving[0], 0.8 * 1.79, 1e-9);
  EXPECT_NEAR(moving[1], -0.8 * 1.79, 1e-9);
}

TEST_F(ComplianceLawTest, ThePapersCompensationIsItsFormulaToTheBit) {
  desired_
      .friction_compensation = 1.0;  // preset `paper`: figures of the papers' jumps must stay what they are
  measured_.velocity_rad_s = pair(0.031, -2.7);
  const JointVector with = torque();
  joints_.friction = {FrictionParameters{}, FrictionParameters{}};
  const JointVector without = torque();
  EXPECT_EQ(with[0], without[0] + 1.79 * std::tanh(0.031 / 0.05));
  EXPECT_EQ(with[1], without[1] + 1.79 * std::tanh(-2.7 / 0.05));
}

TEST_F(ComplianceLawTest, LoadFrictionIsThatOfTheTorqueThatTheGearIsToPutOut) {
  desired_.friction_compensation = 1.0;
  desired_.feedforward_force_N = {0.0, 0.0, 300.0};
  measured_.velocity_rad_s = pair(4.0, 4.0);
  joints_.friction = {FrictionParameters{}, FrictionParameters{}};
  const JointVector spring = torque();
  joints_.friction[0].load_share_driving = joints_.friction[0].load_share_driven = 0.1;
  joints_.friction[1].load_share_driving = joints_.friction[1].load_share_driven = 0.1;
  EXPECT_NEAR(torque()[1], spring[1] + 0.1 * std::abs(spring[1]), 1e-12);
  EXPECT_GT(std::abs(spring[1]), 10.0);
}

TEST_F(ComplianceLawTest, WarmGearsNeedLess) {
  desired_.friction_compensation = 1.0;
  measured_.velocity_rad_s = pair(4.0, 4.0);
  for (FrictionParameters& p : joints_.friction) {
    p = FrictionParameters{};
    p.viscous_Nm_s_rad = 1.3;
    p.viscous_temperature_1_K = 0.035;
  }
  const JointVector unknown = torque();
  measured_.temperature_C = pair(24.0, 50.0);
  EXPECT_EQ(torque()[0], unknown[0]);
  EXPECT_NEAR(unknown[1] - torque()[1], 5.2 * (1.0 - std::exp(-0.035 * 26.0)), 1e-12);
}

TEST_F(ComplianceLawTest, NoLawActsAtRestNorJumpsAboutIt) {
  desired_.friction_compensation = 1.0;
  desired_.damping_N_s_m = {0.0, 0.0, 0.0};
  for (FrictionParameters& p : joints_.friction) p = {7.3, 0.8, 0.1, 2.0, 1.2, 1.0, 0.1, 0.1, 0.05};
  const JointVector rest = torque();
  joints_.friction = {FrictionParameters{}, FrictionParameters{}};
  EXPECT_EQ(torque(), rest);
  joints_.friction = {coulomb(7.3), coulomb(7.3)};
  measured_.velocity_rad_s = pair(1e-4, -1e-4);  // a tenth of the encoder's noise
  EXPECT_LT((torque() - rest).norm(), 0.03);
}

TEST_F(ComplianceLawTest, AtRestFrictionHelpsWhereTheSpringPullsAndNothingElseDoes) {
  desired_.friction_compensation = 0.9;
  joints_.friction = {coulomb(7.3), coulomb(7.3)};
  joints_.rest = {0.02, 0.1};
  desired_.feedforward_force_N = {0.0, 0.0, 51.0};  // weight and feed-forward have no say
  JointCompensation none = joints_;
  none.friction = {FrictionParameters{}, FrictionParameters{}};
  const auto helped = [&] {
    return (torque() - compliance_torque(leg_, desired_, foot_, measured_, none).torque_Nm).eval();
  };
  EXPECT_EQ(helped().norm(), 0.0);
  foot_.position_m += Eigen::Vector3d(0.004, 0.0, -0.02);
  const Eigen::Vector3d spring_N(2000.0 * 0.004, 0.0, 1500.0 * -0.02);
  const JointVector spring_Nm = leg_.jacobian(measured_.position_rad).transpose() * spring_N;
  for (int j = 0; j < 2; ++j) EXPECT_NEAR(helped()[j], 0.9 * 7.3 * std::tanh(spring_Nm[j] / 0.1), 1e-9) << j;
  joints_.stuck_share = {0.2, 0.0};
  const std::array<double, 2> share{1.1, 0.9};
  for (int j = 0; j < 2; ++j)
    EXPECT_NEAR(helped()[j], share[j] * 7.3 * std::tanh(spring_Nm[j] / 0.1), 1e-9) << j;
  const ComplianceTorque all = compliance_torque(leg_, desired_, foot_, measured_, joints_);
  EXPECT_LT((all.spring_torque_Nm - spring_Nm).norm(), 1e-9);
  for (int j = 0; j < 2; ++j) EXPECT_NEAR(all.rest_friction_Nm[j], 7.3, 1e-9);
}

TEST_F(ComplianceLawTest, RestLawGivesWayToTheLawOfMotionWithSpeed) {
  desired_.friction_compensation = 1.0;
  desired_.damping_N_s_m = {0.0, 0.0, 0.0};
  joints_.friction = {coulomb(7.3), coulomb(7.3)};
  foot_.position_m += Eigen::Vector3d(0.004, 0.0, -0.02);
  measured_.velocity_rad_s = pair(0.2, -0.2);
  const JointVector papers = torque();
  joints_.rest = {0.02, 0.1};
  EXPECT_EQ(torque(), papers);  // exp(-100)
  measured_.velocity_rad_s = pair(0.02, -0.02);
  const double share = std::exp(-1.0);
  const JointVector spring_Nm = leg_.jacobian(measured_.position_rad).transpose() *
                                Eigen::Vector3d(2000.0 * 0.004, 0.0, 1500.0 * -0.02);
  const JointVector with = torque();
  joints_.friction = {FrictionParameters{}, FrictionParameters{}};
  const double w[] = {0.02, -0.02};
  for (int j = 0; j < 2; ++j) {
    const double expected_Nm = 7.3 * (share * std::tanh(spring_Nm[j] / 0.1) +
                                      (1.0 - share) * std::tanh(w[j] / 0.05));
    EXPECT_NEAR((with - torque())[j], expected_Nm, 1e-9) << j;
  }
}

TEST_F(ComplianceLawTest, InMotionNoMoreFrictionIsCompensatedThanThereSurelyIsAndAtRestAllOfIt) {
  desired_.friction_compensation = 1.0;
  desired_.damping_N_s_m = {0.0, 0.0, 0.0};
  joints_.rest = {0.02, 0.1};
  joints_.friction_uncertainty = {0.2, 0.3};
  foot_.position_m += Eigen::Vector3d(0.004, 0.0, -0.02);
  const auto helped = [&] {
    JointCompensation none = joints_;
    none.friction = {FrictionParameters{}, FrictionParameters{}};
    return (torque() - compliance_torque(leg_, desired_, foot_, measured_, none).torque_Nm).eval();
  };
  const JointVector at_rest = helped();
  EXPECT_NEAR(std::abs(at_rest[0]), 1.79, 1e-3);
  EXPECT_NEAR(std::abs(at_rest[1]), 1.79, 1e-3);
  measured_.velocity_rad_s = pair(0.5, -0.5);  // the rest law's share is exp(-625)
  EXPECT_NEAR(helped()[0], 0.8 * 1.79, 1e-6);
  EXPECT_NEAR(helped()[1], -0.7 * 1.79, 1e-6);
  joints_.rest = {};  // the papers' law compensates what it is told to
  EXPECT_NEAR(helped()[0], 1.79, 1e-6);
}

TEST_F(ComplianceLawTest, ShareThatIsSurelyThereIsNotTouchedToTheBit) {
  desired_.friction_compensation = 0.8;
  joints_.rest = {0.08, 0.2};
  foot_.position_m += Eigen::Vector3d(0.004, 0.0, -0.02);
  measured_.velocity_rad_s = pair(0.11, -0.07);
  const JointVector before = torque();
  joints_.friction_uncertainty = {0.16, 0.19};
  EXPECT_EQ(torque(), before);
}

TEST_F(ComplianceLawTest, FrictionThatIsLessThanIdentifiedByItsUncertaintyDoesNotDriveAMotionOn) {
  desired_.friction_compensation = 1.0;
  desired_.damping_N_s_m = {0.0, 0.0, 0.0};
  joints_.rest = {0.08, 0.2};
  joints_.friction_uncertainty = {0.2, 0.2};
  JointCompensation none = joints_;
  none.friction = {FrictionParameters{}, FrictionParameters{}};
  for (const double w : {0.02, 0.05, 0.1, 0.2, 1.0, 5.0}) {  // in the target: no spring pulls
    measured_.velocity_rad_s = pair(w, -w);
    const JointVector helped = torque() - compliance_torque(leg_, desired_, foot_, measured_, none).torque_Nm;
    const double true_friction_Nm = 0.8 * 1.79 + 1e-9;
    EXPECT_LE(helped[0], true_friction_Nm) << w;
    EXPECT_GE(helped[1], -true_friction_Nm) << w;
  }
}

TEST_F(ComplianceLawTest, RotorsGetTheirShareOfTheDesiredAcceleration) {
  joints_.armature_kg_m2 = {0.81, 0.6};
  foot_.acceleration_m_s2 = {3.0, 0.0, -12.0};
  const JointVector without = torque();
  desired_.inertia_compensation = 0.5;
  const JointVector acceleration = damped_inverse(leg_.jacobian(measured_.position_rad)).matrix.transpose() *
                                   Eigen::Vector3d(3.0, 0.0, -12.0);
  EXPECT_NEAR((torque() - without)[0], 0.5 * 0.81 * acceleration[0], 1e-9);
  EXPECT_NEAR((torque() - without)[1], 0.5 * 0.6 * acceleration[1], 1e-9);
}

TEST_F(ComplianceLawTest, DesiredAccelerationMakesTheFootDoWhatIsWanted) {
  measured_.velocity_rad_s = pair(3.0, -5.0);
  foot_.acceleration_m_s2 = {4.0, 0.0, 9.0};
  const JointVector qdd = joint_acceleration_rad_s2(leg_, at(), foot_.acceleration_m_s2,
                                                    measured_.velocity_rad_s);
  constexpr double kStep_s = 1e-4;  // second difference of the foot along that motion
  const auto foot_at = [&](double t) {
    return leg_.foot_in_hip_m(measured_.position_rad + t * measured_.velocity_rad_s + 0.5 * t * t * qdd);
  };
  const Eigen::Vector3d a = (foot_at(kStep_s) - 2.0 * foot_at(0.0) + foot_at(-kStep_s)) / (kStep_s * kStep_s);
  EXPECT_LT((a - foot_.acceleration_m_s2).norm(), 1e-3);
}

TEST_F(ComplianceLawTest, InertiaIsNoBiggerThanTheDampedInverseAllowsInASingularPose) {
  measured_.position_rad = pair(1.5, 1e-4);
  foot_.acceleration_m_s2 = {0.0, 0.0, 50.0};
  const JointVector qdd = joint_acceleration_rad_s2(leg_, at(), foot_.acceleration_m_s2,
                                                    measured_.velocity_rad_s);
  EXPECT_TRUE(qdd.allFinite());
  EXPECT_LT(qdd.norm(), 50.0 / 0.02);
}

TEST_F(ComplianceLawTest, LegThatIsLedTakesItsLinksAndTheSharesOfRotorsAndFriction) {
  joints_.friction = {coulomb(5.0), coulomb(7.0)};
  joints_.armature_kg_m2 = {0.5, 0.8};
  measured_.velocity_rad_s = pair(2.0, -3.0);
  foot_.acceleration_m_s2 = {1.0, 0.0, 4.0};
  desired_.friction_compensation = 0.8;
  desired_.inertia_compensation = 0.9;
  const JointVector acceleration = joint_acceleration_rad_s2(leg_, at(), foot_.acceleration_m_s2,
                                                             measured_.velocity_rad_s);
  const JointVector links_Nm = leg_.inverse_dynamics_Nm(measured_.position_rad, measured_.velocity_rad_s,
                                                        acceleration);
  const JointVector led_Nm = led_torque_Nm(leg_, at(), desired_, foot_, measured_, joints_);
  EXPECT_NEAR(led_Nm[0] - links_Nm[0], 0.8 * 5.0 + 0.9 * 0.5 * acceleration[0], 1e-6);
  EXPECT_NEAR(led_Nm[1] - links_Nm[1], -0.8 * 7.0 + 0.9 * 0.8 * acceleration[1], 1e-6);
  joints_.friction_uncertainty = {0.1, 0.6};  // of the second there is surely 0.4
  const JointVector doubted_Nm = led_torque_Nm(leg_, at(), desired_, foot_, measured_, joints_);
  EXPECT_NEAR(doubted_Nm[0], led_Nm[0], 1e-9);
  EXPECT_NEAR(doubted_Nm[1] - led_Nm[1], (0.8 - 0.4) * 7.0, 1e-6);
}

TEST_F(ComplianceLawTest, LegThatIsLedWithoutKnownRotorsTakesItsLinksAlone) {
  joints_.friction = {coulomb(5.0), coulomb(7.0)};
  joints_.armature_kg_m2.clear();
  foot_.acceleration_m_s2 = {0.0, 0.0, 4.0};
  desired_.inertia_compensation = 1.0;
  const JointVector acceleration = joint_acceleration_rad_s2(leg_, at(), foot_.acceleration_m_s2,
                                                             measured_.velocity_rad_s);
  const JointVector links_Nm = leg_.inverse_dynamics_Nm(measured_.position_rad, measured_.velocity_rad_s,
                                                        acceleration);
  EXPECT_EQ(led_torque_Nm(leg_, at(), desired_, foot_, measured_, joints_), links_Nm);
}

TEST(FootMotionTest, ExtrapolatesWithConstantAcceleration) {
  DesiredLeg desired;
  desired.desired_foot_in_hip_m = {0.0, 0.0, -0.4};
  desired.desired_foot_velocity_m_s = {0.0, 0.0, -2.0};
  desired.desired_foot_acceleration_m_s2 = {0.0, 0.0, 10.0};
  const FootMotion foot = extrapolate(desired, 0.01);
  EXPECT_NEAR(foot.position_m.z(), -0.4 - 0.02 + 0.0005, 1e-15);
  EXPECT_NEAR(foot.velocity_m_s.z(), -1.9, 1e-15);
  EXPECT_EQ(foot.acceleration_m_s2.z(), 10.0);
}

}  // namespace
}  // namespace sprung
