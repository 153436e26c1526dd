#include "controller/lowering.h"

#include <algorithm>

#include "model/least_jerk.h"

namespace sprung {
namespace {

bool can_be_led(const DesiredLeg& leg, const EstimatedLeg& now) noexcept {
  const bool led = leg.control_mode == ControlMode::kPosition || leg.control_mode == ControlMode::kCompliance;
  const bool carries = leg.phase != LegPhase::kThrust && leg.phase != LegPhase::kFlight;
  return led && carries && finite(now.estimated_foot_in_hip_m);
}

/// In position control the load has pressed the foot away from where it is desired, and still does.
const Vec3& departure_m(const DesiredLeg& leg, const EstimatedLeg& now) noexcept {
  const bool by_desire = leg.control_mode == ControlMode::kPosition && finite(leg.desired_foot_in_hip_m);
  return by_desire ? leg.desired_foot_in_hip_m : now.estimated_foot_in_hip_m;
}

}  // namespace

Lowering::Lowering(std::size_t leg_count, double sit_length_m, double duration_s)
    : sit_length_m_(sit_length_m), duration_s_(duration_s), feet_(leg_count), command_(leg_count) {}

bool Lowering::begin(const LegCommand& last, const JointState& state) noexcept {
  running_ = false;
  bool any_stands = false;
  for (std::size_t i = 0; i < feet_.size(); ++i) {
    const LegPhase phase = last.legs[i].phase;
    if (!can_be_led(last.legs[i], state.legs[i])) return false;
    DesiredLeg& leg = command_.legs[i];
    leg = DesiredLeg{};
    leg.desired_foot_in_hip_m = departure_m(last.legs[i], state.legs[i]);
    leg.phase = phase;
    leg.control_mode = ControlMode::kPosition;
    feet_[i] = {leg.desired_foot_in_hip_m[2], phase != LegPhase::kSwing && phase != LegPhase::kPreStance};
    any_stands = any_stands || feet_[i].stands;
  }
  began_us_ = state.stamp.utime_us;
  running_ = any_stands;
  return running_;
}

double Lowering::way_m(const Foot& foot) const noexcept {
  return std::max(0.0, -sit_length_m_ - foot.from_m);
}

const LegCommand& Lowering::at(std::int64_t time_us) noexcept {
  const double time_s = 1e-6 * static_cast<double>(time_us - began_us_);
  const LeastJerk down = least_jerk(time_s, duration_s_);
  const LeastJerk put = least_jerk(time_s, kPutDown_s);
  double sum_m = 0.0, rate_sum_m_s = 0.0;
  int standing = 0;
  for (std::size_t i = 0; i < feet_.size(); ++i) {
    if (!feet_[i].stands) continue;
    DesiredLeg& leg = command_.legs[i];
    leg.desired_foot_in_hip_m[2] = feet_[i].from_m + way_m(feet_[i]) * down.share;
    leg.desired_foot_velocity_m_s[2] = way_m(feet_[i]) * down.rate_1_s;
    sum_m += leg.desired_foot_in_hip_m[2];
    rate_sum_m_s += leg.desired_foot_velocity_m_s[2];
    ++standing;
  }
  for (std::size_t i = 0; i < feet_.size(); ++i) {
    if (feet_[i].stands || standing == 0) continue;
    DesiredLeg& leg = command_.legs[i];
    const double to_m = sum_m / standing, lift_m = feet_[i].from_m - to_m;
    leg.desired_foot_in_hip_m[2] = to_m + lift_m * (1.0 - put.share);
    leg.desired_foot_velocity_m_s[2] = rate_sum_m_s / standing * put.share - lift_m * put.rate_1_s;
  }
  command_.stamp.utime_us = time_us;
  running_ = time_s < duration_s_;
  return command_;
}

}  // namespace sprung
