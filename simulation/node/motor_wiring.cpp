#include "simulation/node/motor_wiring.h"

#include <algorithm>
#include <cmath>

#include "signals/angles.h"

namespace sprung::sim {

GainedCurrentLoop::GainedCurrentLoop(double bandwidth_Hz, double step_s) noexcept
    : bandwidth_rad_s_(kTurn_rad * bandwidth_Hz),
      substeps_(std::max(1, static_cast<int>(std::lround(4.0 * step_s / kDeadTime_s)))) {}

void GainedCurrentLoop::switch_off() noexcept { current_A_ = integral_A_ = drive_A_ = 0.0; }

/// In quarters of the dead time, which is a lag here. Voltages are told by the current that they drive through the winding's resistance.
double GainedCurrentLoop::step(double target_A, double gain_p, double gain_i, double voltage_A) noexcept {
  const double dt_s = kDeadTime_s / 4.0;
  for (int i = 0; i < substeps_; ++i) {
    const double error_A = target_A - current_A_;
    integral_A_ = std::clamp(integral_A_ + gain_i * bandwidth_rad_s_ * error_A * dt_s, -voltage_A, voltage_A);
    const double asked_A = gain_p * bandwidth_rad_s_ * kWinding_s * error_A + integral_A_;
    drive_A_ += dt_s / kDeadTime_s * (std::clamp(asked_A, -voltage_A, voltage_A) - drive_A_);
    current_A_ += dt_s / kWinding_s * (drive_A_ - current_A_);
  }
  return current_A_;
}

Commutation::Commutation(const DriveWiring& wiring) noexcept
    : pole_pairs_(wiring.pole_pairs),
      drive_pole_pairs_(wiring.drive_pole_pairs > 0 ? wiring.drive_pole_pairs : wiring.pole_pairs),
      sign_(wiring.phases_swapped ? -1.0 : 1.0),
      error_rad_(wiring.commutation_error_rad) {}

void Commutation::align(double motor_rad, double counts) noexcept {
  start_rad_ = motor_rad;
  start_counts_ = counts;
}

double Commutation::share(double motor_rad, double counts, const MotorBelief& belief,
                          double true_counts_per_turn) const noexcept {
  const double believed_counts = belief.encoder_counts_per_turn > 0.0 ? belief.encoder_counts_per_turn
                                                                      : true_counts_per_turn;
  const double believed_pairs = belief.pole_pairs > 0 ? belief.pole_pairs : drive_pole_pairs_;
  const double psi = pole_pairs_ * start_rad_ + error_rad_ +
                     believed_pairs * kTurn_rad * (counts - start_counts_) / believed_counts;
  return sign_ * std::cos(sign_ * psi - pole_pairs_ * motor_rad);
}

}  // namespace sprung::sim
