#include "estimator/leg_windings.h"

#include <cmath>

namespace sprung {

LegWindings::LegWindings(const RobotConfig& robot, const LegConfig& leg) : transmission_(leg) {
  for (const int i : leg.actuators) {
    const ActuatorConfig& a = robot.actuators.at(static_cast<std::size_t>(i));
    motors_.push_back({static_cast<std::size_t>(i), a.winding_time_constant_s > 0.0,
                       WindingWatch(a.rated_current_A, a.winding_time_constant_s)});
  }
}

void LegWindings::step(const std::vector<ActuatorState>& actuators, double dt_s) noexcept {
  time_us_ += std::llround(1e6 * dt_s);
  for (Motor& motor : motors_) motor.winding.add(actuators[motor.actuator].measured_current_A, time_us_);
}

void LegWindings::write(std::size_t joint, EstimatedJoint& out) const noexcept {
  out.winding_share = out.derating_in_s = kNaN;
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    const Motor& motor = motors_[i];
    if (!motor.known || !transmission_.couples(static_cast<int>(joint), static_cast<int>(i))) continue;
    out.winding_share = std::fmax(out.winding_share, motor.winding.warmth());
    out.derating_in_s = std::fmin(out.derating_in_s, motor.winding.warm_in_s());
  }
}

}  // namespace sprung
