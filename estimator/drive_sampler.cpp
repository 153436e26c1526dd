#include "estimator/drive_sampler.h"

#include <algorithm>
#include <cmath>

#include "signals/angles.h"

namespace sprung {
namespace {

/// CiA 402 torque actual value 0x6077 comes in thousandths of the rated torque.
constexpr double kCurrentStep = 1e-3;
/// The drive counts as limited this close to its torque limit.
constexpr double kSaturatedAt = 0.99;

double torque_per_A(const ActuatorConfig& a) noexcept { return a.gear_ratio * a.torque_constant_Nm_A; }

/// Beyond them nothing was measured: 160,000 turns of an output, and what no drive's object can hold. The
/// filter's squares of such numbers would no longer be finite.
constexpr double kFarthest_rad = 1e6;
constexpr double kMostCurrent_A = 1e6;

bool measured(const ActuatorState& s) noexcept {  // false of NaN too
  return std::abs(s.measured_position_rad) < kFarthest_rad && std::abs(s.measured_current_A) < kMostCurrent_A;
}

/// Of a drive that answers; silence is the joint estimator's to count.
JointStatus drive_status(const ActuatorState& s, const ActuatorConfig& a) noexcept {
  if (s.power_state == PowerState::kFault || s.power_state == PowerState::kFaultReactionActive) {
    return JointStatus::kFault;
  }
  if (!s.referenced) return JointStatus::kNotReferenced;
  const bool limited = std::abs(s.measured_current_A) * torque_per_A(a) >= kSaturatedAt * a.torque_limit_Nm;
  return limited ? JointStatus::kSaturated : JointStatus::kOk;
}

bool drive_enabled(const ActuatorState& s) noexcept {
  return s.power_state == PowerState::kOperationEnabled &&
         (s.shown_mode == DriveMode::kTorque || s.shown_mode == DriveMode::kPosition);
}

}  // namespace

DriveSampler::DriveSampler(const RobotConfig& robot, const LegConfig& leg)
    : indices_(leg.actuators), transmission_(leg) {
  JointVector quantisation(transmission_.size());
  for (std::size_t i = 0; i < indices_.size(); ++i) {
    const ActuatorConfig& a = robot.actuators.at(indices_[i]);
    actuators_.push_back(a);
    quantisation[static_cast<int>(i)] = 0.5 * kCurrentStep * a.rated_current_A * torque_per_A(a);
  }
  quantisation_Nm_ = transmission_.joint_torque_bound(quantisation);
}

const ActuatorState& DriveSampler::state(const std::vector<ActuatorState>& actuators, int i) const noexcept {
  return actuators[indices_[i]];
}

void DriveSampler::sample(const std::vector<ActuatorState>& actuators,
                          std::vector<JointSample>& samples) const noexcept {
  const int n = transmission_.size();
  JointVector position(n), link(n), torque(n);
  for (int i = 0; i < n; ++i) {
    const ActuatorState& s = state(actuators, i);
    // 0 * NaN is NaN: without this a drive would spoil joints that it does not move.
    position[i] = measured(s) ? s.measured_position_rad : 0.0;
    link[i] = s.measured_link_position_rad;
    torque[i] = measured(s) ? torque_per_A(actuators_[i]) * s.measured_current_A : 0.0;
  }
  const JointVector joint_position = transmission_.joint_from_actuator(position);
  const JointVector joint_torque = transmission_.joint_torque(torque);
  for (int j = 0; j < n; ++j) {
    JointSample& out = samples[j];
    out = joint_sample(j, actuators);
    out.measured_position_rad = joint_position[j];
    out.measured_link_position_rad = joint_link(j, link);
    out.motor_angle_rad = position[j] * actuators_[j].gear_ratio;
    out.motor_torque_Nm = joint_torque[j];
    out.current_quantisation_Nm = quantisation_Nm_[j];
  }
}

/// NaN where a link encoder that this joint needs is missing.
double DriveSampler::joint_link(int joint, const JointVector& link_rad) const noexcept {
  const double joint_rad = transmission_.joint_from_coupled(joint, link_rad);
  return std::isfinite(joint_rad) ? joint_rad : kNaN;
}

JointSample DriveSampler::joint_sample(int joint,
                                       const std::vector<ActuatorState>& actuators) const noexcept {
  JointSample out;
  out.fresh = out.drive_enabled = true;
  for (int i = 0; i < transmission_.size(); ++i) {
    if (!transmission_.couples(joint, i)) continue;
    const ActuatorState& s = state(actuators, i);
    out.fresh = out.fresh && s.age_cycles == 0 && measured(s);
    out.drive_enabled = out.drive_enabled && drive_enabled(s);
    // The wire values are in order of harm.
    out.drive_status = std::max(out.drive_status, drive_status(s, actuators_[i]));
  }
  return out;
}

double DriveSampler::encoder_step_rad(int joint) const noexcept {
  const int n = transmission_.size();
  JointVector step(n);
  for (int i = 0; i < n; ++i) {
    const ActuatorConfig& a = actuators_[i];
    step[i] = 2.0 * kPi / (a.encoder_counts_per_turn * a.gear_ratio);
  }
  return transmission_.joint_motion_bound(step)[joint];
}

}  // namespace sprung
