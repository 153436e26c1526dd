#include "tools/experiments/jump_metrics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sprung {

namespace {

constexpr double kContact_N = 1.0;             // true vertical force that counts as ground contact
constexpr std::int64_t kFlight_us = 30'000;    // shorter hops off the ground are no flight
constexpr std::int64_t kLanding_us = 300'000;  // S0 Fig. 12 shows about this much of the landing
constexpr double kStopMargin_rad = 0.03;

std::size_t joint_named(const RobotConfig& robot, const std::string& name) {
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    if (robot.joints[i].name == name) {
      return i;
    }
  }
  throw std::invalid_argument("robot " + robot.name + " has no joint '" + name +
                              "', which this experiment measures");
}

double ground_force_N(const SimTruth& truth) {
  double force_N = 0.0;
  for (const TrueLeg& leg : truth.legs) {
    force_N += leg.true_contact_force_N[2];
  }
  return force_N;
}

/// NaN is no peak yet.
void raise(double& peak, double value) {
  peak = std::isnan(peak) ? std::abs(value) : std::max(peak, std::abs(value));
}

}  // namespace

JumpMetrics::JumpMetrics(const RobotConfig& robot)
    : hip_(joint_named(robot, "hip")),
      knee_(joint_named(robot, "knee")),
      folded_knee_rad_(robot.joints[knee_].position_max_rad - kStopMargin_rad) {}

void JumpMetrics::add(const MotionState& motion, const JointState& joints, const SimTruth& truth) {
  if (motion.state == MotionPhase::kThrust && last_phase_ != MotionPhase::kThrust) {
    begin_jump(truth.stamp.utime_us);
  }
  last_phase_ = motion.state;
  if (span_ == Span::kNone) {
    return;
  }
  follow_peaks(joints, truth);
  follow_flight(truth);
  follow_landing(motion, joints, truth);
}

void JumpMetrics::begin_jump(std::int64_t time_us) {
  jumps_.emplace_back();
  span_ = Span::kGround;
  thrust_us_ = time_us;
  folded_ = false;
}

void JumpMetrics::follow_peaks(const JointState& joints, const SimTruth& truth) {
  JumpResult& jump = jumps_.back();
  if (span_ == Span::kLanded) {
    if (truth.stamp.utime_us - touchdown_us_ <= kLanding_us) {
      raise(jump.landing_knee_torque_Nm, joints.joints[knee_].motor_side_torque_Nm);
      raise(jump.landing_knee_output_torque_Nm, truth.joints[knee_].true_gear_output_torque_Nm);
    }
    return;
  }
  raise(jump.peak_hip_torque_Nm, joints.joints[hip_].motor_side_torque_Nm);
  raise(jump.peak_knee_torque_Nm, joints.joints[knee_].motor_side_torque_Nm);
  raise(jump.peak_knee_output_torque_Nm, truth.joints[knee_].true_gear_output_torque_Nm);
}

void JumpMetrics::follow_flight(const SimTruth& truth) {
  const bool on_ground = ground_force_N(truth) > kContact_N;
  const double height_m = truth.base_in_world_m[2];
  const std::int64_t now_us = truth.stamp.utime_us;
  if (span_ == Span::kGround && !on_ground) {
    span_ = Span::kAir;
    liftoff_us_ = now_us;
    liftoff_height_m_ = top_height_m_ = height_m;
  } else if (span_ == Span::kAir) {
    top_height_m_ = std::max(top_height_m_, height_m);
    if (on_ground) {
      span_ = now_us - liftoff_us_ >= kFlight_us ? Span::kLanded : Span::kGround;
      touchdown_us_ = now_us;
      jumps_.back().lowest_hip_m = height_m;
    }
  }
}

void JumpMetrics::follow_landing(const MotionState& motion, const JointState& joints, const SimTruth& truth) {
  if (span_ != Span::kLanded) {
    return;
  }
  JumpResult& jump = jumps_.back();
  jump.lowest_hip_m = std::min(jump.lowest_hip_m, truth.base_in_world_m[2]);
  folded_ = folded_ || joints.joints[knee_].estimated_position_rad > folded_knee_rad_;
  jump.touchdown_time_ms = static_cast<double>(touchdown_us_ - thrust_us_) * 1e-3;
  if (motion.state == MotionPhase::kStanding || motion.state == MotionPhase::kCrouch) {
    jump.upright = !folded_;
    jump.height_mm = jump.upright ? (top_height_m_ - liftoff_height_m_) * 1e3 : kNaN;
    span_ = Span::kNone;
  }
}

}  // namespace sprung
