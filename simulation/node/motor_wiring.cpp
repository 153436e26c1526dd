#include "simulation/node/motor_wiring.h"

#include <algorithm>
#include <cmath>

#include "signals/angles.h"

namespace sprung::sim {

namespace {
constexpr int kSubsteps = 4;  ///< of a period, in which the current is integrated
}

GainedCurrentLoop::GainedCurrentLoop(double bandwidth_Hz, double step_s) noexcept
    : bandwidth_rad_s_(kTurn_rad * bandwidth_Hz),
      substeps_(std::max(1, static_cast<int>(std::lround(kSubsteps * step_s / kPeriod_s)))) {}

void GainedCurrentLoop::switch_off() noexcept {
  current_A_ = integral_A_ = applied_A_ = next_A_ = 0.0;
  phase_ = 0;
}

/// What is computed in one period is applied in the next. Voltages are told by the current that they drive
/// through the winding's resistance.
void GainedCurrentLoop::control(double error_A, double gain_p, double gain_i, double voltage_A) noexcept {
  applied_A_ = next_A_;
  integral_A_ = std::clamp(integral_A_ + gain_i * bandwidth_rad_s_ * error_A * kPeriod_s, -voltage_A,
                           voltage_A);
  next_A_ = std::clamp(gain_p * bandwidth_rad_s_ * kWinding_s * error_A + integral_A_, -voltage_A, voltage_A);
}

double GainedCurrentLoop::step(double target_A, double gain_p, double gain_i, double voltage_A) noexcept {
  const double share = 1.0 - std::exp(-kPeriod_s / kSubsteps / kWinding_s);
  for (int i = 0; i < substeps_; ++i) {
    if (phase_ == 0) control(target_A - current_A_, gain_p, gain_i, voltage_A);
    phase_ = (phase_ + 1) % kSubsteps;
    current_A_ += share * (applied_A_ - current_A_);
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
