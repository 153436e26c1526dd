#include "estimator/joint_estimator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "model/friction/coulomb_friction.h"
#include "robots/robot_loader.h"

namespace sprung {
namespace {

constexpr double kJointEstimatorDt_s = 0.001;
constexpr double kEncoderStep_rad = 2.0 * 3.14159265358979 / 131072.0 / 100.0;
constexpr int kCoast = 2;

JointSample fresh(double position_rad, double torque_Nm) {
  JointSample sample;
  sample.measured_position_rad = position_rad;
  sample.motor_torque_Nm = torque_Nm;
  sample.fresh = sample.drive_enabled = true;
  return sample;
}

/// What a data sheet and the paper's bench say.
JointConfig not_identified() {
  JointConfig joint = load_robot("single_leg").joints[1];
  joint.armature_kg_m2 = 0.6;
  joint.friction.reset();
  joint.uncertainty = JointUncertainty{};
  joint.uncertainty.friction = kPapersFrictionUncertainty;
  return joint;
}

class JointEstimatorTest : public testing::Test {
 protected:
  EstimatedJoint step(const JointSample& sample) {
    EstimatedJoint out;
    estimator_.step(sample, kJointEstimatorDt_s, out);
    return out;
  }
  EstimatedJoint settle(double position_rad, double torque_Nm) {
    EstimatedJoint out;
    for (int k = 0; k < 60; ++k) out = step(fresh(position_rad, torque_Nm));
    return out;
  }

  JointConfig joint_ = not_identified();
  JointEstimator estimator_{joint_, {}, kJointEstimatorDt_s, kEncoderStep_rad, kCoast};
};

TEST_F(JointEstimatorTest, FirstSampleStartsWithoutAJump) {
  const EstimatedJoint first = step(fresh(1.3, 20.0));
  EXPECT_EQ(first.status, JointStatus::kStarting);
  EXPECT_DOUBLE_EQ(first.estimated_position_rad, 1.3);
  EXPECT_DOUBLE_EQ(first.estimated_velocity_rad_s, 0.0);
  EXPECT_NEAR(first.estimated_acceleration_rad_s2, 0.0, 1e-12);
  EXPECT_NEAR(first.gear_output_torque_Nm, 20.0, 1e-9);
  const EstimatedJoint later = settle(1.3, 20.0);
  EXPECT_EQ(later.status, JointStatus::kOk);
  EXPECT_NEAR(later.estimated_velocity_rad_s, 0.0, 1e-12);
  EXPECT_NEAR(later.gear_output_torque_Nm, 20.0, 1e-9);
}

TEST_F(JointEstimatorTest, MotorSideTorqueIsThePapersEquation) {
  EstimatedJoint out;
  for (int k = 0; k < 200; ++k) out = step(fresh(1.0 - 0.5 * k * kJointEstimatorDt_s, -12.0));
  EXPECT_NEAR(out.estimated_velocity_rad_s, -0.5, 1e-3);
  EXPECT_NEAR(out.friction_torque_Nm, -joint_.coulomb_friction_Nm, 1e-6);
  EXPECT_NEAR(out.motor_side_torque_Nm, -12.0 + joint_.coulomb_friction_Nm, 1e-6);
}

TEST_F(JointEstimatorTest, RotorsOwnAccelerationIsNotGearTorque) {
  // A free rotor: all motor torque goes into its inertia, the link feels nothing.
  EstimatedJoint out;
  const double torque_Nm = 60.0 + joint_.coulomb_friction_Nm;
  const double acceleration = 60.0 / joint_.armature_kg_m2;
  for (int k = 0; k < 100; ++k) {
    const double t = k * kJointEstimatorDt_s;
    out = step(fresh(1.0 + 0.5 * acceleration * t * t, torque_Nm));
  }
  EXPECT_NEAR(out.estimated_acceleration_rad_s2, acceleration, 0.1);
  EXPECT_NEAR(out.motor_side_torque_Nm, 60.0, 1e-6);
  EXPECT_NEAR(out.gear_output_torque_Nm, 0.0, 0.1);
}

TEST_F(JointEstimatorTest, CoastsThroughAFewMissingSamples) {
  for (int k = 0; k < 100; ++k) step(fresh(1.0 + 2.0 * k * kJointEstimatorDt_s, joint_.coulomb_friction_Nm));
  JointSample missing;
  missing.drive_enabled = true;
  EstimatedJoint out;
  for (int k = 0; k < kCoast; ++k) out = step(missing);
  EXPECT_EQ(out.status, JointStatus::kOk);
  EXPECT_NEAR(out.estimated_position_rad, 1.0 + 2.0 * (99 + kCoast) * kJointEstimatorDt_s, 1e-5);
  EXPECT_TRUE(std::isfinite(out.gear_output_torque_Nm));
}

TEST_F(JointEstimatorTest, LongSilenceIsStaleWithNanTorquesAndThenStartsAnew) {
  settle(1.0, 5.0);
  EstimatedJoint out;
  for (int k = 0; k <= kCoast; ++k) out = step(JointSample{});
  EXPECT_EQ(out.status, JointStatus::kStale);
  EXPECT_TRUE(std::isnan(out.measured_motor_torque_Nm));
  EXPECT_TRUE(std::isnan(out.motor_side_torque_Nm));
  EXPECT_TRUE(std::isnan(out.gear_output_torque_Nm));
  EXPECT_TRUE(std::isnan(out.gear_output_torque_bound_Nm));
  out = step(fresh(1.4, 5.0));
  EXPECT_EQ(out.status, JointStatus::kStarting);
  EXPECT_DOUBLE_EQ(out.estimated_position_rad, 1.4);
  EXPECT_DOUBLE_EQ(out.estimated_velocity_rad_s, 0.0);
}

TEST_F(JointEstimatorTest, NothingIsKnownBeforeTheFirstGoodSample) {
  const EstimatedJoint out = step(JointSample{});
  EXPECT_EQ(out.status, JointStatus::kStarting);
  EXPECT_TRUE(std::isnan(out.estimated_position_rad));
  EXPECT_TRUE(std::isnan(out.gear_output_torque_Nm));
  for (int k = 0; k < kCoast; ++k) step(JointSample{});
  EXPECT_EQ(step(JointSample{}).status, JointStatus::kStale);
}

TEST_F(JointEstimatorTest, CycleThatIsTooSlowIsRefusedByKeyAndRemedy) {
  std::string said = "accepted";
  try {
    JointEstimator slow(joint_, {}, 1.0 / 200.0, kEncoderStep_rad, kCoast);
  } catch (const std::invalid_argument& error) {
    said = error.what();
  }
  EXPECT_EQ(said,
            "robot.yaml: key 'cycle_rate': found 200 Hz, expected at least 250 Hz, below which the estimator "
            "cannot follow a joint: raise it");
  EXPECT_NO_THROW(JointEstimator(joint_, {}, 1.0 / 250.0, kEncoderStep_rad, kCoast));
}

/// Velocity by the motor alone over one cycle in which the torque has come up from nothing to 10 Nm.
double speed_after_a_step_rad_s(double drive_loop_kHz) {
  JointConfig joint = not_identified();
  joint.coulomb_friction_Nm = 0.0;
  EstimationConfig estimation;
  estimation.drive_loop_kHz = drive_loop_kHz;
  JointEstimator estimator(joint, estimation, kJointEstimatorDt_s, kEncoderStep_rad, kCoast);
  EstimatedJoint out;
  for (int k = 0; k < 50; ++k) estimator.step(fresh(1.0, 0.0), kJointEstimatorDt_s, out);
  const double share = 0.5 + 0.5 / drive_loop_kHz;  // of a cycle of 1 ms
  const double moved_rad = 0.5 * share * 10.0 / joint.armature_kg_m2 * kJointEstimatorDt_s *
                           kJointEstimatorDt_s;
  estimator.step(fresh(1.0 + moved_rad, 10.0), kJointEstimatorDt_s, out);
  return out.estimated_velocity_rad_s;
}

TEST_F(JointEstimatorTest, NewestCurrentCountsByTheTurnsOfTheDrivesLoopInACycle) {
  const double whole_rad_s = 10.0 / joint_.armature_kg_m2 * kJointEstimatorDt_s;
  EXPECT_NEAR(speed_after_a_step_rad_s(1.0), whole_rad_s, 1e-9);
  EXPECT_NEAR(speed_after_a_step_rad_s(4.0), 0.625 * whole_rad_s, 1e-9);
  EXPECT_NEAR(speed_after_a_step_rad_s(8.0), 0.5625 * whole_rad_s, 1e-9);
}

TEST_F(JointEstimatorTest, JitterAndNoiseOfTheRobotAreInTheBounds) {
  EstimationConfig coarse;
  coarse.sampling_jitter_us = 50.0;
  coarse.current_noise_Nm = 20.0;
  JointEstimator other(joint_, coarse, kJointEstimatorDt_s, kEncoderStep_rad, kCoast);
  EstimatedJoint fine, rough;
  for (int k = 0; k < 100; ++k) {
    const JointSample sample = fresh(1.0 + 3.0 * k * kJointEstimatorDt_s, joint_.coulomb_friction_Nm);
    fine = step(sample);
    other.step(sample, kJointEstimatorDt_s, rough);
  }
  EXPECT_GT(rough.estimated_position_bound_rad, 5.0 * fine.estimated_position_bound_rad);
  EXPECT_GT(rough.estimated_acceleration_bound_rad_s2, 1.96 * 20.0 / joint_.armature_kg_m2);
}

TEST_F(JointEstimatorTest, MotorTorqueIsOutputAndFrictionAndInertiaAlways) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> even(-1.0, 1.0);
  double q = 1.0;
  for (int k = 0; k < 500; ++k) {
    q += k < 250 ? 0.0 : 1e-3 * even(random);
    const double torque_Nm = 30.0 * even(random);
    const EstimatedJoint out = step(fresh(q, torque_Nm));
    ASSERT_NEAR(out.gear_output_torque_Nm + out.friction_torque_Nm +
                    joint_.armature_kg_m2 * out.estimated_acceleration_rad_s2,
                torque_Nm, 1e-9);
    ASSERT_EQ(out.measured_motor_torque_Nm, torque_Nm);
    ASSERT_NEAR(out.motor_side_torque_Nm +
                    papers_friction_Nm(joint_.coulomb_friction_Nm, out.estimated_velocity_rad_s),
                torque_Nm, 1e-9);
  }
}

TEST_F(JointEstimatorTest, SaysWhetherItsFrictionIsIdentified) {
  EXPECT_FALSE(step(fresh(1.0, 0.0)).identified);
  joint_.friction = IdentifiedFriction{};
  JointEstimator identified(joint_, {}, kJointEstimatorDt_s, kEncoderStep_rad, kCoast);
  EstimatedJoint out;
  identified.step(fresh(1.0, 0.0), kJointEstimatorDt_s, out);
  EXPECT_TRUE(out.identified);
}

/// A torque that a stuck gear takes is no gear output: the estimate stays, the bound says how wrong it may
/// be.
TEST_F(JointEstimatorTest, StuckJointKeepsItsEstimateWithABoundThatHolds) {
  joint_.friction = IdentifiedFriction{};
  joint_.friction->parameters.coulomb_Nm = 7.0;
  joint_.uncertainty.friction = 0.1;
  estimator_ = JointEstimator(joint_, {}, kJointEstimatorDt_s, kEncoderStep_rad, kCoast);
  settle(1.0, 10.0);
  for (double torque_Nm : {10.0, 12.0, 15.0, 8.0, 4.0}) {
    const EstimatedJoint out = settle(1.0, torque_Nm);
    EXPECT_TRUE(out.at_rest);
    EXPECT_NEAR(out.gear_output_torque_Nm, 10.0, 1e-9);
    EXPECT_GE(out.gear_output_torque_bound_Nm, 7.0 + std::abs(torque_Nm - 10.0) - 0.05);
    EXPECT_NEAR(out.estimated_acceleration_rad_s2, 0.0, 1e-9);
  }
}

/// A joint at rest under a load that changes: the motor's side cannot see it, the twist of its gear can, once
/// a move has shown where its zero is.
TEST_F(JointEstimatorTest, AtRestTheTorsionOfTheGearDecides) {
  constexpr double kStiffness_Nm_rad = 25000.0, kZero_rad = 2e-4, kFriction_Nm = 4.0;
  joint_.friction = IdentifiedFriction{};
  joint_.friction->parameters.coulomb_Nm = kFriction_Nm;
  joint_.torsion = GearTorsion{};
  joint_.torsion->stiffness_Nm_rad = joint_.torsion->second_stiffness_Nm_rad = kStiffness_Nm_rad;
  joint_.torsion->angle_std_rad = 1e-5;
  estimator_ = JointEstimator(joint_, {}, kJointEstimatorDt_s, kEncoderStep_rad, kCoast);
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 1e-5);
  const auto cycle = [&](double q, double motor_Nm, double load_Nm) {
    JointSample sample = fresh(q, motor_Nm);
    sample.measured_link_position_rad = q - load_Nm / kStiffness_Nm_rad - kZero_rad + noise(random);
    sample.motor_angle_rad = 100.0 * q;
    return step(sample);
  };
  for (int k = 0; k < 2000; ++k) {  // to and fro at 0.2 rad/s under 3 Nm
    const double w = k < 1000 ? 0.2 : -0.2, q = 1.0 + 0.2 * kJointEstimatorDt_s * (k < 1000 ? k : 2000 - k);
    cycle(q, 3.0 + std::copysign(kFriction_Nm, w), 3.0);
  }
  double squares = 0.0, covered = 0.0;
  constexpr int kCycles = 2000;
  for (int k = 0; k < kCycles + 100; ++k) {
    const double load_Nm = 3.5 * std::sin(2.0 * 3.14159265358979 * k / 1000.0);
    const EstimatedJoint out = cycle(1.0, 0.0, load_Nm);
    if (k < 100) continue;
    const double error_Nm = out.gear_output_torque_Nm - load_Nm;
    squares += error_Nm * error_Nm;
    covered += std::abs(error_Nm) <= out.gear_output_torque_bound_Nm ? 1.0 : 0.0;
    ASSERT_TRUE(out.at_rest);
    ASSERT_NEAR(out.gear_output_torque_Nm + out.friction_torque_Nm, 0.0, 1e-9);
  }
  EXPECT_LT(std::sqrt(squares / kCycles), 0.5);  // the gear holds 4 Nm; one angle's noise is 0.25 Nm
  EXPECT_GT(covered / kCycles, 0.93);
}

TEST_F(JointEstimatorTest, ALinkEncoderThatFallsSilentLeavesTheMotorsSide) {
  joint_.torsion = GearTorsion{};
  joint_.torsion->stiffness_Nm_rad = joint_.torsion->second_stiffness_Nm_rad = 25000.0;
  joint_.torsion->angle_std_rad = 1e-5;
  estimator_ = JointEstimator(joint_, {}, kJointEstimatorDt_s, kEncoderStep_rad, kCoast);
  const EstimatedJoint out = settle(1.0, 5.0);
  EXPECT_TRUE(std::isnan(out.torsion_torque_Nm));
  EXPECT_NEAR(out.gear_output_torque_Nm, 5.0, 1e-9);
}

TEST_F(JointEstimatorTest, EncodersThatDisagreeShowNoTwist) {
  joint_.torsion = GearTorsion{};
  joint_.torsion->stiffness_Nm_rad = joint_.torsion->second_stiffness_Nm_rad = 25000.0;
  joint_.torsion->angle_std_rad = 1e-5;
  for (const double apart_rad : {0.002, 0.02, -0.02}) {
    estimator_ = JointEstimator(joint_, {}, kJointEstimatorDt_s, kEncoderStep_rad, kCoast);
    settle(1.0, 5.0);
    JointSample sample = fresh(1.0, 5.0);
    sample.measured_link_position_rad = 1.0 + apart_rad;
    EXPECT_EQ(std::isnan(step(sample).torsion_torque_Nm), std::abs(apart_rad) > 0.01) << apart_rad;
  }
}

TEST_F(JointEstimatorTest, HomingStartsItAnewInsteadOfAsAMotion) {
  JointSample sample = fresh(0.2, 5.0);
  sample.drive_status = JointStatus::kNotReferenced;
  for (int k = 0; k < 60; ++k) EXPECT_EQ(step(sample).status, JointStatus::kNotReferenced);
  const EstimatedJoint out = step(fresh(1.4, 5.0));
  EXPECT_EQ(out.status, JointStatus::kStarting);
  EXPECT_DOUBLE_EQ(out.estimated_position_rad, 1.4);
  EXPECT_DOUBLE_EQ(out.estimated_velocity_rad_s, 0.0);
}

TEST_F(JointEstimatorTest, FaultOutranksAllElse) {
  settle(1.0, 5.0);
  JointSample sample = fresh(1.0, 5.0);
  for (JointStatus status : {JointStatus::kSaturated, JointStatus::kNotReferenced, JointStatus::kFault}) {
    sample.drive_status = status;
    EXPECT_EQ(step(sample).status, status);
  }
  sample.drive_status = JointStatus::kFault;
  sample.fresh = false;
  for (int k = 0; k < 10; ++k) EXPECT_EQ(step(sample).status, JointStatus::kFault);
}

/// Push-off of a loaded knee (after facts C2): 94 Hz torque loop, PD onto a half-sine extension in 0.1 s,
/// gear friction, load of 33 Nm that ends with take-off. Fine steps, encoder counts and current noise as the
/// drive has them.
struct PushOff {
  std::vector<double> encoder_rad, motor_Nm, output_Nm;
};

PushOff push_off(double armature, double friction, std::uint32_t seed, double jitter_s) {
  constexpr double kFine_s = 1e-5;
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  PushOff run;
  double q = 1.9, w = 0.0, torque = -10.0, before = q;
  for (int i = 0; i < 20000; ++i) {
    const double t = i * kFine_s;
    const double x = std::clamp((t - 0.02) / 0.1, 0.0, 1.0);
    const double want = 1.9 - 1.2 * x * x * (3.0 - 2.0 * x);
    const double rate = -1.2 * 6.0 * x * (1.0 - x) / 0.1;
    const double command = std::clamp(503.0 * (want - q) + 29.7 * (rate - w), -171.6, 171.6);
    torque += kFine_s * 2.0 * 3.14159265358979 * 94.0 * (command - torque);
    const double push = t < 0.10 ? 23.0 * std::sin(3.14159265358979 * std::max(0.0, t - 0.02) / 0.08) : 0.0;
    const double output = t < 0.10 ? -10.0 - push : 0.0;
    const double acceleration = (torque - friction * std::tanh(w / 0.005) - output) / armature;
    if (i % 100 == 0) {
      const double measured = q + jitter_s * noise(random) * w;
      run.encoder_rad.push_back(std::round(measured / kEncoderStep_rad) * kEncoderStep_rad);
      run.motor_Nm.push_back(torque + 0.5 * noise(random));
      run.output_Nm.push_back(output);
    }
    w += kFine_s * acceleration;
    q += kFine_s * w;
    before = q;
  }
  EXPECT_LT(before, 1.0);  // the leg did extend
  return run;
}

struct Quality {
  double rms_Nm = 0.0, papers_rms_Nm = 0.0, covered = 0.0;
};

Quality assess(const JointConfig& joint, const PushOff& run) {
  JointEstimator estimator(joint, {}, kJointEstimatorDt_s, kEncoderStep_rad, kCoast);
  Quality q;
  int count = 0;
  for (std::size_t k = 0; k < run.encoder_rad.size(); ++k) {
    EstimatedJoint out;
    estimator.step(fresh(run.encoder_rad[k], run.motor_Nm[k]), kJointEstimatorDt_s, out);
    if (out.status != JointStatus::kOk) continue;
    const double error = out.gear_output_torque_Nm - run.output_Nm[k];
    const double papers_error = out.motor_side_torque_Nm - run.output_Nm[k];
    q.rms_Nm += error * error;
    q.papers_rms_Nm += papers_error * papers_error;
    q.covered += std::abs(error) <= out.gear_output_torque_bound_Nm ? 1.0 : 0.0;
    ++count;
  }
  q.rms_Nm = std::sqrt(q.rms_Nm / count);
  q.papers_rms_Nm = std::sqrt(q.papers_rms_Nm / count);
  q.covered /= count;
  return q;
}

TEST_F(JointEstimatorTest, PushOffIsTenTimesBetterThanThePapersEquationWhenTheModelIsRight) {
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    const Quality q = assess(joint_, push_off(joint_.armature_kg_m2, joint_.coulomb_friction_Nm, seed, 0.0));
    EXPECT_LT(q.rms_Nm,
              2.2);  // facts physics 13: momentum observer 2.2, Kalman without the motor's input 2.9
    EXPECT_LT(q.rms_Nm, 0.1 * q.papers_rms_Nm);
    EXPECT_GT(q.covered, 0.95);
  }
}

TEST_F(JointEstimatorTest, SamplingJitterOfAMicrosecondIsBorne) {
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    const Quality q = assess(joint_, push_off(joint_.armature_kg_m2, joint_.coulomb_friction_Nm, seed, 1e-6));
    EXPECT_LT(q.rms_Nm, 2.8);  // facts physics 11: momentum observer 2.8, second difference 11
  }
}

/// Not identified: friction of 1.79 Nm to within 180 %, armature of 0.6 kg m^2 to within 20 %, one standard
/// deviation each.
TEST_F(JointEstimatorTest, BoundCoversPlantsWithinTheStatedUncertainty) {
  struct Plant {
    double armature_kg_m2, friction_Nm;
  };
  for (const Plant plant : {Plant{0.6, 7.3}, Plant{0.72, 1.79}, Plant{0.70, 4.5}}) {
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
      const Quality q = assess(joint_, push_off(plant.armature_kg_m2, plant.friction_Nm, seed, 1e-6));
      EXPECT_GT(q.covered, 0.95) << plant.armature_kg_m2 << " " << plant.friction_Nm;
    }
  }
}

/// J3 is at the edge in both at once (0.81 kg m^2, 7.3 Nm), where a statistical bound need not hold any more.
TEST_F(JointEstimatorTest, PlantOfThePapersThatTheModelDoesNotKnowIsStillBetterThanTheirEquation) {
  for (std::uint32_t seed = 1; seed <= 5; ++seed) {
    const Quality q = assess(joint_, push_off(0.81, 7.3, seed, 1e-6));
    EXPECT_LT(q.rms_Nm, 0.5 * q.papers_rms_Nm);
  }
}

}  // namespace
}  // namespace sprung
