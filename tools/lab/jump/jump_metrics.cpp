#include "tools/lab/jump/jump_metrics.h"

#include <algorithm>

#include "tools/lab/run/scoring.h"

namespace sprung {

namespace {

constexpr std::int64_t kFlight_us = 30'000;    // shorter hops off the ground are no flight
constexpr std::int64_t kLanding_us = 300'000;  // S0 Fig. 12 shows about this much of the landing
constexpr double kStopMargin_rad = 0.03;
constexpr double kPathDelay_cycles = 1.0;  // LEG_COMMAND(k) is used in cycle k + 1 (docs/architecture.md)

double lowest_foot_m(const SimTruth& truth) {
  double height_m = truth.legs.front().true_foot_in_world_m[2];
  for (const TrueLeg& leg : truth.legs) height_m = std::min(height_m, leg.true_foot_in_world_m[2]);
  return height_m;
}

}  // namespace

JumpMetrics::JumpMetrics(const RobotConfig& robot, double floor_m)
    : hip_(measured_joint(robot, "hip")),
      knee_(measured_joint(robot, "knee")),
      folded_knee_rad_(robot.joints[knee_].position_max_rad - kStopMargin_rad),
      cycle_s_(robot.cycle_s),
      standing_foot_m_(floor_m + robot.legs.front().foot_radius_m) {}

void JumpMetrics::add(const MotionState& motion, const JointState& joints, const SimTruth& truth,
                      const LegCommand* desired) {
  if (motion.state == MotionPhase::kThrust && last_phase_ != MotionPhase::kThrust) {
    begin_jump(truth.stamp.utime_us);
  }
  last_phase_ = motion.state;
  if (span_ == Span::kNone) {
    return;
  }
  follow_flight(truth);
  follow_lengths(truth, desired);
  follow_peaks(joints, truth);
  follow_landing(motion, joints, truth);
}

void JumpMetrics::begin_jump(std::int64_t time_us) {
  jumps_.emplace_back();
  span_ = Span::kGround;
  thrust_us_ = longest_us_ = longest_desired_us_ = time_us;
  longest_m_ = longest_desired_m_ = 0.0;
  folded_ = false;
}

void JumpMetrics::follow_lengths(const SimTruth& truth, const LegCommand* desired) {
  if (span_ == Span::kLanded) return;
  const double length_m = truth.base_in_world_m[2] - lowest_foot_m(truth);
  if (length_m > longest_m_) {
    longest_m_ = length_m;
    longest_us_ = truth.stamp.utime_us;
  }
  if (desired == nullptr) return;
  const double desired_m = -desired->legs.front().desired_foot_in_hip_m[2];
  if (desired_m > longest_desired_m_) {
    longest_desired_m_ = desired_m;
    longest_desired_us_ = truth.stamp.utime_us;
  }
  jumps_.back().y_lag_ms = 1e-3 * static_cast<double>(longest_us_ - longest_desired_us_);
}

void JumpMetrics::follow_peaks(const JointState& joints, const SimTruth& truth) {
  JumpResult& jump = jumps_.back();
  if (span_ == Span::kGround) {
    follow_push_off(joints, truth);
  } else if (span_ == Span::kAir) {
    raise_peak(jump.flight_knee_torque_Nm, joints.joints[knee_].motor_side_torque_Nm);
  } else if (truth.stamp.utime_us - touchdown_us_ <= kLanding_us) {
    raise_peak(jump.landing_hip_torque_Nm, joints.joints[hip_].motor_side_torque_Nm);
    raise_peak(jump.landing_knee_torque_Nm, joints.joints[knee_].motor_side_torque_Nm);
    raise_peak(jump.landing_hip_output_torque_Nm, truth.joints[hip_].true_gear_output_torque_Nm);
    raise_peak(jump.landing_knee_output_torque_Nm, truth.joints[knee_].true_gear_output_torque_Nm);
  }
}

void JumpMetrics::follow_push_off(const JointState& joints, const SimTruth& truth) {
  JumpResult& jump = jumps_.back();
  raise_peak(jump.peak_hip_torque_Nm, joints.joints[hip_].motor_side_torque_Nm);
  raise_peak(jump.peak_hip_output_torque_Nm, truth.joints[hip_].true_gear_output_torque_Nm);
  raise_peak(jump.peak_knee_output_torque_Nm, truth.joints[knee_].true_gear_output_torque_Nm);
  if (raise_peak(jump.peak_knee_torque_Nm, joints.joints[knee_].motor_side_torque_Nm))
    jump.time_to_peak_ms = since_thrust_ms(truth.stamp.utime_us) - 1e3 * kPathDelay_cycles * cycle_s_;
  for (const std::size_t joint : {hip_, knee_}) {
    const TrueJoint& j = truth.joints[joint];
    jump.positive_work_J += std::max(0.0, j.true_motor_torque_Nm * j.true_velocity_rad_s) * cycle_s_;
  }
}

void JumpMetrics::follow_flight(const SimTruth& truth) {
  const bool on_floor = lowest_foot_m(truth) <= standing_foot_m_;
  const double height_m = truth.base_in_world_m[2];
  const std::int64_t now_us = truth.stamp.utime_us;
  if (span_ == Span::kGround && !on_floor) {
    span_ = Span::kAir;
    takeoff_us_ = now_us;
    jumps_.back().takeoff_time_ms = since_thrust_ms(now_us);
    takeoff_height_m_ = top_height_m_ = height_m;
  } else if (span_ == Span::kAir) {
    top_height_m_ = std::max(top_height_m_, height_m);
    if (on_floor) touch_down(truth);
  }
}

void JumpMetrics::touch_down(const SimTruth& truth) {
  touchdown_us_ = truth.stamp.utime_us;
  if (touchdown_us_ - takeoff_us_ < kFlight_us) {
    span_ = Span::kGround;
    return;
  }
  span_ = Span::kLanded;
  JumpResult& jump = jumps_.back();
  jump.lowest_hip_m = truth.base_in_world_m[2];
  jump.touchdown_time_ms = since_thrust_ms(touchdown_us_);
  jump.touchdown_leg_mm = 1e3 * (truth.base_in_world_m[2] - lowest_foot_m(truth));
}

void JumpMetrics::follow_landing(const MotionState& motion, const JointState& joints, const SimTruth& truth) {
  if (span_ != Span::kLanded) {
    return;
  }
  JumpResult& jump = jumps_.back();
  jump.lowest_hip_m = std::min(jump.lowest_hip_m, truth.base_in_world_m[2]);
  folded_ = folded_ || joints.joints[knee_].estimated_position_rad > folded_knee_rad_;
  if (motion.state == MotionPhase::kStanding || motion.state == MotionPhase::kCrouch) {
    jump.upright = !folded_;
    jump.height_mm = jump.upright ? (top_height_m_ - takeoff_height_m_) * 1e3 : kNaN;
    span_ = Span::kNone;
  }
}

}  // namespace sprung
