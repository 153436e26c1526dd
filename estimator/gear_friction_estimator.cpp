#include "estimator/gear_friction_estimator.h"

#include <algorithm>
#include <cmath>

#include "model/friction/gear_output.h"

namespace sprung {
namespace {

/// Below this a joint may be at rest: the slowest motion that the papers identify at is ten times faster;
/// above it friction's sign is known. Hysteresis, since the filter's velocity is noisy.
constexpr double kRest_rad_s = 0.005;
constexpr double kResume = 2.0;
/// The encoder of a joint at rest may flicker: this many standard deviations are no motion.
constexpr double kVelocityNoiseStds = 4.0;
/// Beyond what friction at rest can hold, in standard deviations of the tracked torque: the joint
/// accelerates.
constexpr double kSureAccelerationStds = 4.0;
/// Of the motor's torque at rest: ten times a cycle of 1 kHz, short beside all that people and gravity do.
constexpr double kSmoothing_s = 0.01;

}  // namespace

GearFrictionEstimator::GearFrictionEstimator(const JointConfig& joint) noexcept
    : stated_(joint.estimated_friction()), law_(stated_), presliding_(law_.presliding_rad) {}

FrictionInput GearFrictionEstimator::input(double velocity_rad_s, double sign,
                                           double output_Nm) const noexcept {
  FrictionInput in;
  in.velocity_rad_s = velocity_rad_s;
  in.gear_output_torque_Nm = output_Nm;
  in.temperature_C = temperature_C_;
  in.sign = sign;
  return in;
}

void GearFrictionEstimator::start(double position_rad, double motor_torque_Nm) noexcept {
  presliding_.reset(position_rad);
  at_rest_ = true;
  motor_Nm_ = output_Nm_ = motor_torque_Nm;
  friction_Nm_ = rest_distance_Nm_ = 0.0;
}

double GearFrictionEstimator::ahead_Nm(double motor_torque_Nm) const noexcept {
  if (!at_rest_) return friction_.torque_Nm;
  const GearOutput possible = solve_gear_output(law_, motor_torque_Nm, input(0.0, 0.0, output_Nm_));
  return motor_torque_Nm - std::clamp(output_Nm_, possible.low_Nm, possible.high_Nm);
}

void GearFrictionEstimator::adapt(const FrictionFactors& factors) noexcept {
  factors_ = factors;
  law_ = scaled(stated_, factors);
}

FrictionByLaw GearFrictionEstimator::friction_by_law() const noexcept {
  return {(friction_.torque_Nm - friction_.viscous_Nm) / factors_.dry,
          friction_.viscous_Nm / factors_.viscous};
}

bool GearFrictionEstimator::accelerates(const Motion& motion) const noexcept {
  const GearOutput held = solve_gear_output(law_, motion.motor_torque_Nm, input(0.0, 0.0, output_Nm_));
  const double beyond_Nm = std::max(held.low_Nm - motion.tracked_output_Nm,
                                    motion.tracked_output_Nm - held.high_Nm);
  return beyond_Nm > kSureAccelerationStds * motion.tracked_output_std_Nm;
}

void GearFrictionEstimator::decide_rest(const Motion& motion) noexcept {
  const double least_rad_s = std::max(kRest_rad_s, kVelocityNoiseStds * motion.velocity_std_rad_s);
  const bool was_at_rest = at_rest_;
  at_rest_ = std::abs(motion.velocity_rad_s) < (was_at_rest ? kResume : 1.0) * least_rad_s &&
             !accelerates(motion);
  if (at_rest_ && !was_at_rest) motor_Nm_ = motion.motor_torque_Nm;
}

void GearFrictionEstimator::hold(const Motion& motion) noexcept {
  motor_Nm_ += std::min(1.0, motion.dt_s / kSmoothing_s) * (motion.motor_torque_Nm - motor_Nm_);
  const GearOutput possible = solve_gear_output(law_, motor_Nm_, input(0.0, 0.0, output_Nm_));
  output_Nm_ = std::clamp(output_Nm_, possible.low_Nm, possible.high_Nm);
  friction_Nm_ = motion.motor_torque_Nm - output_Nm_;
  rest_distance_Nm_ = std::max(possible.high_Nm - output_Nm_, output_Nm_ - possible.low_Nm);
  friction_ = loaded_friction(law_, input(0.0, 1.0, output_Nm_));
}

void GearFrictionEstimator::follow(const Motion& motion) noexcept {
  output_Nm_ = motion.tracked_output_Nm;
  const double sign = law_.presliding_rad > 0.0 ? presliding_.sign() : kNaN;
  friction_ = loaded_friction(law_, input(motion.velocity_rad_s, sign, output_Nm_));
  friction_Nm_ = friction_.torque_Nm;
  rest_distance_Nm_ = 0.0;
}

void GearFrictionEstimator::update(const Motion& motion) noexcept {
  temperature_C_ = motion.temperature_C;
  presliding_.step(motion.measured_position_rad);
  decide_rest(motion);
  if (at_rest_) {
    hold(motion);
  } else {
    follow(motion);
  }
}

void GearFrictionEstimator::learn_output(double output_Nm) noexcept {
  if (at_rest_) output_Nm_ = output_Nm;
}

}  // namespace sprung
