#include "estimator/leg_estimator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "model/friction/friction_law.h"
#include "robots/robot_loader.h"
#include "tests/support/allocation_count.h"

namespace sprung {
namespace {

/// A leg that holds its pose while motors, weight and a force on the foot balance.
class LegEstimatorTest : public testing::Test {
 protected:
  void balance(const Eigen::Vector3d& force_N) {
    const auto leg = make_leg_kinematics(robot_.legs[0]);
    JointVector q(2);
    q << 2.4, 1.6;
    const JointVector torque_Nm = leg->gravity_torque_Nm(q) - leg->jacobian(q).transpose() * force_N;
    for (std::size_t i = 0; i < 2; ++i) {
      const ActuatorConfig& motor = robot_.actuators[i];
      ActuatorState& a = actuators_[i];
      a.measured_position_rad = q[static_cast<int>(i)];
      a.measured_current_A = torque_Nm[static_cast<int>(i)] / (motor.gear_ratio * motor.torque_constant_Nm_A);
      a.power_state = PowerState::kOperationEnabled;
      a.shown_mode = DriveMode::kPosition;
      a.referenced = true;
    }
  }
  /// In the air, to and fro in 0.6 s, by motors that also overcome so much viscous friction that no law
  /// knows. @param hand_Nm along the motion of each joint: the motors hold it back.
  void swing(double seconds, double unknown_Nm_s_rad, double hand_Nm = 0.0) {
    const auto leg = make_leg_kinematics(robot_.legs[0]);
    const double rate = 2.0 * M_PI / 0.6;
    JointVector q(2), w(2), a(2);
    for (int k = 0; k < std::lround(seconds / robot_.cycle_s); ++k, swung_s_ += robot_.cycle_s) {
      const double sine = std::sin(rate * swung_s_), cosine = std::cos(rate * swung_s_);
      q << 2.4 - 0.3 * cosine, 1.6 + 0.3 * cosine;
      w << 0.3 * rate * sine, -0.3 * rate * sine;
      a << 0.3 * rate * rate * cosine, -0.3 * rate * rate * cosine;
      const double speed_rad_s = std::max(1e-3, std::abs(w[0]));
      move(*leg, q, w, a, unknown_Nm_s_rad - hand_Nm / speed_rad_s);
    }
  }
  /// Both joints swing by these accelerations, as the model says that they do.
  bool touches_when_it_moves_by(const std::function<double(double)>& acceleration_rad_s2, double seconds) {
    const auto leg = make_leg_kinematics(robot_.legs[0]);
    JointVector q(2), w(2), a(2);
    q << 2.4, 1.4;
    w << 0.5, 0.5;
    constexpr double kSettles_s = 0.1;
    bool touched = false;
    for (double t = 0.0; t < seconds; t += robot_.cycle_s) {
      a.setConstant(acceleration_rad_s2(t));
      move(*leg, q, w, a, 0.0);
      touched = touched || (t > kSettles_s && out_.contact);
      q += robot_.cycle_s * w + 0.5 * robot_.cycle_s * robot_.cycle_s * a;
      w += robot_.cycle_s * a;
    }
    return touched;
  }
  /// One cycle in the air, as the model says that it moves, and friction that no law knows.
  void move(const LegKinematics& leg, const JointVector& q, const JointVector& w, const JointVector& a,
            double unknown_Nm_s_rad) {
    const JointVector links_Nm = leg.inverse_dynamics_Nm(leg.pose(q), w, a);
    for (int i = 0; i < 2; ++i) {
      const JointConfig& joint = robot_.joints[static_cast<std::size_t>(i)];
      FrictionInput at;
      at.velocity_rad_s = w[i];
      drive(i, q[i],
            links_Nm[i] + joint.armature_kg_m2 * a[i] + unknown_Nm_s_rad * w[i] +
                friction_torque_Nm(joint.estimated_friction(), at));
    }
    run(1);
  }
  void drive(int i, double position_rad, double torque_Nm) {
    const ActuatorConfig& motor = robot_.actuators[static_cast<std::size_t>(i)];
    ActuatorState& a = actuators_[static_cast<std::size_t>(i)];
    a.measured_position_rad = position_rad;
    a.measured_current_A = torque_Nm / (motor.gear_ratio * motor.torque_constant_Nm_A);
    a.power_state = PowerState::kOperationEnabled;
    a.shown_mode = DriveMode::kPosition;
    a.referenced = true;
  }
  void run(int cycles) {
    for (int k = 0; k < cycles; ++k) leg_.step(actuators_, robot_.cycle_s, joints_, out_);
  }

  double swung_s_ = 0.0;
  RobotConfig robot_ = load_robot("single_leg");
  LegEstimator leg_{robot_, robot_.legs[0], 2};
  std::vector<ActuatorState> actuators_{2};
  std::vector<EstimatedJoint> joints_{2};
  EstimatedLeg out_;
};

TEST_F(LegEstimatorTest, ForceOnTheFootHasABoundOnEveryAxis) {
  balance({-8.0, 0.0, 120.0});
  run(100);
  EXPECT_NEAR(out_.foot_force_N[0], -8.0, 0.1);
  EXPECT_NEAR(out_.foot_force_N[2], 120.0, 0.1);
  EXPECT_GT(out_.foot_force_bound_N[0], 1.0);
  EXPECT_GT(out_.foot_force_bound_N[2], 1.0);
  EXPECT_EQ(out_.foot_force_bound_N[1], 0.0);  // a leg in a plane feels nothing across it
}

TEST_F(LegEstimatorTest, BoundOfTheExternalTorqueHasTheGearsAndTheLegsModel) {
  balance({0.0, 0.0, 60.0});
  run(100);
  for (const EstimatedJoint& joint : joints_)
    EXPECT_GT(joint.external_torque_bound_Nm, joint.gear_output_torque_bound_Nm);
  const double known_Nm = joints_[0].external_torque_bound_Nm;
  for (JointConfig& joint : robot_.joints) joint.uncertainty.mass = 1.0;
  leg_ = LegEstimator(robot_, robot_.legs[0], 2);
  run(100);
  EXPECT_GT(joints_[0].external_torque_bound_Nm, known_Nm);
}

TEST_F(LegEstimatorTest, ForceBoundIsBetweenIndependentAndAlikeErrors) {
  balance({0.0, 0.0, 60.0});
  run(100);
  const auto leg = make_leg_kinematics(robot_.legs[0]);
  JointVector q(2);
  q << joints_[0].estimated_position_rad, joints_[1].estimated_position_rad;
  const LegJacobian to_force = damped_inverse(leg->jacobian(q)).matrix;
  const double hip_N = std::abs(to_force(2, 0)) * joints_[0].external_torque_bound_Nm;
  const double knee_N = std::abs(to_force(2, 1)) * joints_[1].external_torque_bound_Nm;
  EXPECT_GT(out_.foot_force_bound_N[2], std::hypot(hip_N, knee_N));
  EXPECT_LT(out_.foot_force_bound_N[2], hip_N + knee_N);
}

TEST_F(LegEstimatorTest, LoadThatNoStuckGearCouldHoldIsContactAndItsEndIsSeen) {
  balance({0.0, 0.0, 120.0});
  run(20);
  EXPECT_TRUE(out_.contact);
  balance({0.0, 0.0, -120.0});  // pulled: nothing stands on a ceiling
  run(20);
  EXPECT_FALSE(out_.contact);
}

TEST_F(LegEstimatorTest, JointsThatMoveAsTheirModelsSayFit) {
  swing(3.0, 0.0);
  for (const EstimatedJoint& joint : joints_) {
    EXPECT_TRUE(joint.model_fits);
    EXPECT_EQ(joint.misfit_reason, MisfitReason::kNone);
    EXPECT_LT(joint.misfit_ratio, 1.5);
  }
}

TEST_F(LegEstimatorTest, FrictionThatNoLawKnowsIsSaidAndWidensEveryBoundWithinASecond) {
  swing(1.0, 0.0);
  const std::vector<EstimatedJoint> fitting = joints_;
  swing(1.0, 7.4);
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    EXPECT_FALSE(joints_[j].model_fits) << j;
    EXPECT_GT(joints_[j].misfit_ratio, 2.0);
    EXPECT_GT(joints_[j].gear_output_torque_bound_Nm, fitting[j].gear_output_torque_bound_Nm);
    EXPECT_GT(joints_[j].friction_torque_bound_Nm, fitting[j].friction_torque_bound_Nm);
    EXPECT_GT(joints_[j].external_torque_bound_Nm, fitting[j].external_torque_bound_Nm);
  }
}

TEST_F(LegEstimatorTest, ADriveThatJoltsItsLegIsNoContact) {
  const auto jolt = [](double t) {  // as one that changes its mode in flight
    return t > 0.15 && t < 0.158 ? -150.0 * std::sin(M_PI * (t - 0.15) / 0.008) : t < 0.15 ? 20.0 : 0.0;
  };
  EXPECT_FALSE(touches_when_it_moves_by(jolt, 0.2));
}

TEST_F(LegEstimatorTest, StandingTeachesNothingOfTheModel) {
  balance({0.0, 0.0, 120.0});
  run(2000);
  ASSERT_TRUE(out_.contact);
  for (const EstimatedJoint& joint : joints_) {
    EXPECT_TRUE(joint.model_fits);
    EXPECT_EQ(joint.misfit_ratio, 0.0);
  }
}

TEST_F(LegEstimatorTest, AMissingDriveMeansNoContactAndNoForce) {
  balance({0.0, 0.0, 120.0});
  run(20);
  actuators_[1].measured_current_A = kNaN;
  run(5);
  EXPECT_FALSE(out_.contact);
  EXPECT_TRUE(std::isnan(out_.foot_force_N[2]));
  EXPECT_TRUE(std::isnan(out_.foot_force_bound_N[2]));
}

TEST_F(LegEstimatorTest, StepsAllocateNothing) {
  balance({0.0, 0.0, 120.0});
  run(1);
  const std::int64_t before = test::allocation_count();
  for (int k = 0; k < 200; ++k) {
    actuators_[0].measured_position_rad += 1e-4;
    actuators_[1].measured_current_A = k % 50 == 49 ? kNaN : 1.0;
    run(1);
  }
  EXPECT_EQ(test::allocation_count(), before);
}

TEST(LegEstimatorOfAnArm, ContactAtTheEndOfOneLinkIsFound) {
  const RobotConfig robot = load_robot("test_axis");
  const auto arm = make_leg_kinematics(robot.legs[0]);
  ASSERT_NE(arm, nullptr);
  LegEstimator leg(robot, robot.legs[0], 2);
  JointVector q(1);
  q << 0.5;
  const JointVector torque_Nm = arm->gravity_torque_Nm(q) -
                                arm->jacobian(q).transpose() * Eigen::Vector3d(0.0, 0.0, 150.0);
  std::vector<ActuatorState> actuators(1);
  actuators[0].measured_position_rad = 0.5;
  actuators[0].measured_current_A = torque_Nm[0] /
                                    (robot.actuators[0].gear_ratio * robot.actuators[0].torque_constant_Nm_A);
  actuators[0].referenced = true;
  std::vector<EstimatedJoint> joints(1);
  EstimatedLeg out;
  for (int k = 0; k < 50; ++k) leg.step(actuators, robot.cycle_s, joints, out);
  EXPECT_TRUE(out.contact);
  EXPECT_GT(out.foot_force_N[2], 20.0);
}

/// An arm that swings through the air with 1 Nm more friction than its law says: its gear must be cold.
class SwingingArm {
 public:
  /// @param learns friction and warmth on the way.
  explicit SwingingArm(bool learns = true) {
    robot_.legs[0].contact_on_N = 1e4;  // touches nothing, whatever friction does
    robot_.estimation.adapts_friction = learns;
  }

  /// @param held what the caller's joint holds before each step.
  EstimatedJoint swing(const EstimatedJoint& held) {
    LegEstimator leg(robot_, robot_.legs[0], 2);
    std::vector<EstimatedJoint> joints(1);
    EstimatedLeg foot;
    for (int k = 0; k < 1000; ++k) {
      joints[0] = held;
      leg.step(drive(0.3 + kSpeed_rad_s * k * robot_.cycle_s), robot_.cycle_s, joints, foot);
    }
    return joints[0];
  }

 private:
  static constexpr double kSpeed_rad_s = 0.8;

  std::vector<ActuatorState> drive(double position_rad) const {
    JointVector q(1);
    q << position_rad;
    FrictionInput motion;
    motion.velocity_rad_s = kSpeed_rad_s;
    motion.sign = 1.0;
    motion.gear_output_torque_Nm = arm_->gravity_torque_Nm(q)[0];
    const ActuatorConfig& motor = robot_.actuators[0];
    const double torque_Nm = arm_->gravity_torque_Nm(q)[0] + 1.0 +
                             friction_torque_Nm(robot_.joints[0].estimated_friction(), motion);
    std::vector<ActuatorState> out(1);
    out[0].measured_position_rad = position_rad;
    out[0].measured_current_A = torque_Nm / (motor.gear_ratio * motor.torque_constant_Nm_A);
    out[0].power_state = PowerState::kOperationEnabled;
    out[0].shown_mode = DriveMode::kTorque;
    out[0].referenced = true;
    return out;
  }

  RobotConfig robot_ = load_robot("test_axis");
  std::unique_ptr<LegKinematics> arm_ = make_leg_kinematics(robot_.legs[0]);
};

TEST(LegEstimatorOfAnArm, FrictionOfASwingTellsTheGearsTemperature) {
  const double ambient_C = load_robot("test_axis").joints[0].thermal.ambient_C;
  EXPECT_LT(SwingingArm().swing({}).estimated_temperature_degC, ambient_C - 0.1);
}

TEST(LegEstimatorOfAnArm, SwitchedOffTheGearsWarmthIsNotLearntEither) {
  const double ambient_C = load_robot("test_axis").joints[0].thermal.ambient_C;
  EXPECT_NEAR(SwingingArm(false).swing({}).estimated_temperature_degC, ambient_C, 0.05);
}

TEST(LegEstimatorOfAnArm, WhatAnOutputHeldIsNoState) {
  EstimatedJoint held;
  held.external_torque_Nm = 40.0;
  held.estimated_velocity_rad_s = held.gear_output_torque_Nm = held.friction_torque_Nm = -77.0;
  const EstimatedJoint clean = SwingingArm().swing({}), dirty = SwingingArm().swing(held);
  EXPECT_EQ(dirty.estimated_temperature_degC, clean.estimated_temperature_degC);
  EXPECT_EQ(dirty.external_torque_Nm, clean.external_torque_Nm);
  EXPECT_EQ(dirty.gear_output_torque_Nm, clean.gear_output_torque_Nm);
}

TEST_F(LegEstimatorTest, FrictionThatIsALittleMoreIsLearntAndSwitchedOffItIsNot) {
  swing(20.0, 0.5);
  for (const EstimatedJoint& joint : joints_) {
    EXPECT_TRUE(joint.model_fits);
    EXPECT_GT(joint.dry_friction_factor, 1.02);
  }
  robot_.estimation.adapts_friction = false;
  leg_ = LegEstimator(robot_, robot_.legs[0], 2);
  swing(20.0, 0.5);
  for (const EstimatedJoint& joint : joints_) EXPECT_EQ(joint.dry_friction_factor, 1.0);
}

TEST_F(LegEstimatorTest, AHandThatMovesTheLegAgainstItsMotorsTeachesNoFriction) {
  swing(0.6, 0.0);
  const double before[] = {joints_[0].dry_friction_factor, joints_[1].dry_friction_factor};
  swing(20.0, -40.0);  // the motors brake, and it moves all the same
  for (int j = 0; j < 2; ++j) EXPECT_NEAR(joints_[j].dry_friction_factor, before[j], 0.04) << j;
}

TEST_F(LegEstimatorTest, AHandThatMovesTheLegAgainstItsMotorsIsNoMisfitOfTheModel) {
  swing(0.6, 0.0);
  swing(6.0, 0.0, 60.0);
  for (const EstimatedJoint& joint : joints_) {
    EXPECT_EQ(joint.misfit_reason, MisfitReason::kNone);
    EXPECT_LT(joint.misfit_ratio, kMisfitRatio);
  }
}

TEST_F(LegEstimatorTest, AHandThatHelpsTheMotorsIsTakenForLittleLessFriction) {
  swing(20.0, -12.0);  // where a swing is slow it cannot be told from less friction
  for (const EstimatedJoint& joint : joints_) EXPECT_GT(joint.dry_friction_factor, 0.8);
}

}  // namespace
}  // namespace sprung
