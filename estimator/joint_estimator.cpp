#include "estimator/joint_estimator.h"

#include <cmath>

#include "estimator/coulomb_friction.h"
#include "estimator/torque_bound.h"

namespace sprung {
namespace {

// 120 Hz: RMS error of the gear output torque in tests/estimator's push-off, right model, without and with 1 us of sampling
// jitter: 60 Hz 2.8 and 2.8 Nm, 90 Hz 2.0 and 2.1, 120 Hz 1.6 and 2.1, 160 Hz 1.3 and 3.1, 220 Hz 1.1 and 6.2.
constexpr double kBandwidth_rad_s = 2.0 * 3.14159265358979 * 120.0;
constexpr double kLag_s = 2.0 / kBandwidth_rad_s;
/// The filter's slowest error is below 1 % after this many times 1 / bandwidth.
constexpr double kSettlingBandwidths = 10.0;
constexpr double kUniformStd = 0.2886751345948129;  // of a quantisation step: 1 / sqrt(12)

}  // namespace

JointEstimator::JointEstimator(const JointConfig& joint, double cycle_s, double encoder_step_rad,
                               int longest_coast_cycles)
    : joint_(joint),
      gains_(solve_tracking_gains(cycle_s, kBandwidth_rad_s)),
      acceleration_std_rad_s2_(gains_.acceleration_std_1_s2 * encoder_step_rad * kUniformStd),
      longest_coast_cycles_(longest_coast_cycles),
      settling_samples_(static_cast<int>(std::ceil(kSettlingBandwidths / (kBandwidth_rad_s * cycle_s)))) {}

void JointEstimator::reset() noexcept {
  state_ = {};
  motor_torque_Nm_ = output_torque_Nm_ = kNaN;
  input_rad_s2_ = 0.0;
  fresh_samples_ = 0;
  coasted_cycles_ = 0;
}

void JointEstimator::step(const JointSample& sample, double dt_s, EstimatedJoint& out) noexcept {
  const bool was_stale = coasted_cycles_ > longest_coast_cycles_;
  if (sample.fresh && was_stale) reset();
  if (fresh_samples_ > 0) {
    track(sample, dt_s);
  } else if (sample.fresh) {
    start(sample);
  } else {
    ++coasted_cycles_;
  }
  out = EstimatedJoint{};
  out.status = status(sample);
  out.drive_enabled = sample.drive_enabled;
  if (fresh_samples_ > 0) write_motion(out);
  if (fresh_samples_ > 0 && out.status != JointStatus::kStale) write_torques(dt_s, out);
}

/// At rest, and the link balances the motor: nothing accelerates, so nothing jumps.
void JointEstimator::start(const JointSample& sample) noexcept {
  reset();
  motor_torque_Nm_ = sample.motor_torque_Nm;
  quantisation_Nm_ = sample.current_quantisation_Nm;
  state_.position_rad = sample.measured_position_rad;
  input_rad_s2_ = motor_acceleration(motor_torque_Nm_);
  state_.unexplained_rad_s2 = -input_rad_s2_;
  fresh_samples_ = 1;
}

void JointEstimator::track(const JointSample& sample, double dt_s) noexcept {
  if (!sample.fresh) {
    ++coasted_cycles_;
    predict(state_, dt_s, input_rad_s2_);
    return;
  }
  // The torque acted over the interval; its mean is the best guess that two samples allow.
  const double input_now = motor_acceleration(sample.motor_torque_Nm);
  predict(state_, dt_s, 0.5 * (input_rad_s2_ + input_now));
  correct(state_, gains_, sample.measured_position_rad);
  motor_torque_Nm_ = sample.motor_torque_Nm;
  quantisation_Nm_ = sample.current_quantisation_Nm;
  input_rad_s2_ = input_now;
  coasted_cycles_ = 0;
  if (fresh_samples_ < settling_samples_) ++fresh_samples_;
}

double JointEstimator::motor_acceleration(double motor_torque_Nm) const noexcept {
  if (!(joint_.armature_kg_m2 > 0.0)) return 0.0;
  const double friction_Nm = papers_friction(joint_.coulomb_friction_Nm, state_.velocity_rad_s).torque_Nm;
  return (motor_torque_Nm - friction_Nm) / joint_.armature_kg_m2;
}

JointStatus JointEstimator::status(const JointSample& sample) const noexcept {
  if (sample.drive_status == JointStatus::kFault) return JointStatus::kFault;
  if (coasted_cycles_ > longest_coast_cycles_) return JointStatus::kStale;
  if (sample.drive_status == JointStatus::kNotReferenced) return JointStatus::kNotReferenced;
  if (fresh_samples_ < settling_samples_) return JointStatus::kStarting;
  return sample.drive_status;
}

void JointEstimator::write_motion(EstimatedJoint& out) const noexcept {
  out.estimated_position_rad = state_.position_rad;
  out.estimated_velocity_rad_s = state_.velocity_rad_s;
  out.estimated_acceleration_rad_s2 = input_rad_s2_ + state_.unexplained_rad_s2;
}

void JointEstimator::write_torques(double dt_s, EstimatedJoint& out) noexcept {
  out.friction_torque_Nm = papers_friction(joint_.coulomb_friction_Nm, state_.velocity_rad_s).torque_Nm;
  out.motor_side_torque_Nm = motor_torque_Nm_ - out.friction_torque_Nm;
  out.gear_output_torque_Nm =
      out.motor_side_torque_Nm - joint_.armature_kg_m2 * out.estimated_acceleration_rad_s2;
  const double change_Nm =
      std::isfinite(output_torque_Nm_) ? out.gear_output_torque_Nm - output_torque_Nm_ : 0.0;
  output_torque_Nm_ = out.gear_output_torque_Nm;
  TorqueBoundInput in;
  in.motor_torque_Nm = motor_torque_Nm_;
  in.friction_torque_Nm = out.friction_torque_Nm;
  in.acceleration_rad_s2 = out.estimated_acceleration_rad_s2;
  in.acceleration_std_rad_s2 = acceleration_std_rad_s2_;
  in.output_torque_rate_Nm_s = dt_s > 0.0 ? change_Nm / dt_s : 0.0;
  in.lag_s = kLag_s;
  in.current_quantisation_Nm = quantisation_Nm_;
  out.gear_output_torque_bound_Nm = torque_bound_Nm(joint_, in);
}

}  // namespace sprung
