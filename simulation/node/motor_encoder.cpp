#include "simulation/node/motor_encoder.h"

#include <cmath>

#include "signals/angles.h"
#include "simulation/hash_noise.h"

namespace sprung::sim {
namespace {}  // namespace

MotorEncoder::MotorEncoder(const EncoderTruth& truth) noexcept
    : truth_(truth), counts_per_rad_(truth.counts_per_turn * truth.gear_ratio / kTurn_rad) {}

/// Number of the motor turn, counted from index pulse to index pulse.
double MotorEncoder::index_turn(double shaft_rad) const noexcept {
  return std::floor((shaft_rad * truth_.gear_ratio - truth_.index_rad) / kTurn_rad);
}

double MotorEncoder::tick(double shaft_rad) noexcept {
  ++ticks_;
  if (!started_) {
    started_ = true;
    zero_counts_ = truth_.absolute ? 0.0 : std::floor(shaft_rad * counts_per_rad_);
    jumped_counts_ = 0.0;
    counts_at_index_ = 0.0;
    index_turn_ = index_turn(shaft_rad);
  }
  if (!stuck_) pass_index(shaft_rad);
  last_counts_ = read(shaft_rad);
  return last_counts_;
}

/// Going up, the pulse is at the new turn's begin; going down, at the old one's.
void MotorEncoder::pass_index(double shaft_rad) noexcept {
  const double turn = index_turn(shaft_rad);
  if (turn == index_turn_) return;
  const double pulse_rad = (turn < index_turn_ ? turn + 1.0 : turn) * kTurn_rad + truth_.index_rad;
  counts_at_index_ = std::floor(pulse_rad / truth_.gear_ratio * counts_per_rad_) - zero_counts_ +
                     jumped_counts_;
  index_turn_ = turn;
}

double MotorEncoder::read(double shaft_rad) const noexcept {
  if (stuck_) return last_counts_;
  const double counts = std::floor(shaft_rad * counts_per_rad_) - zero_counts_ + jumped_counts_;
  if (noise_counts_ == 0.0) return counts;
  return counts + std::round(noise_counts_ * hash_noise(truth_.seed, truth_.signal, ticks_));
}

void MotorEncoder::set_fault(FaultKind kind, double value, bool on) noexcept {
  if (kind == FaultKind::kEncoderStuck) stuck_ = on;
  if (kind == FaultKind::kEncoderJump && on) jumped_counts_ += std::round(value * counts_per_rad_);
  if (kind == FaultKind::kEncoderNoise) noise_counts_ = on ? value * counts_per_rad_ : 0.0;
}

}  // namespace sprung::sim
