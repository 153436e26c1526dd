#pragma once
/// The encoder on a motor's shaft: counts, index pulse, and its faults. Pure; angles are of the gear's
/// output, in the motor's own forward direction.
#include <cstdint>

#include "signals/modes.h"

namespace sprung::sim {

struct EncoderTruth {
  double counts_per_turn = 0.0;  ///< of the motor
  double gear_ratio = 1.0;
  bool absolute = true;    ///< false: count 0 is where the shaft was at power-on
  double index_rad = 0.0;  ///< of the motor's shaft, where the index pulse is
  std::uint64_t seed = 0;
  std::uint64_t signal = 0;  ///< number of its noise, if it gets any
};

class MotorEncoder {
 public:
  explicit MotorEncoder(const EncoderTruth& truth) noexcept;

  double counts_per_rad() const noexcept { return counts_per_rad_; }
  /// The next reading is count 0, unless the encoder is absolute.
  void power_on() noexcept { started_ = false; }
  /// Once a tick. @return what the drive's loops see.
  double tick(double shaft_rad) noexcept;
  /// At a SYNC, between ticks.
  double read(double shaft_rad) const noexcept;
  /// Count at the newest index pulse since power-on, 0 before the first; the shaft must move over it.
  double counts_at_index() const noexcept { return counts_at_index_; }
  /// kEncoderStuck, kEncoderJump, kEncoderNoise; ignores the others.
  void set_fault(FaultKind kind, double value, bool on) noexcept;

 private:
  double index_turn(double shaft_rad) const noexcept;
  void pass_index(double shaft_rad) noexcept;

  EncoderTruth truth_;
  double counts_per_rad_;
  bool started_ = false;
  bool stuck_ = false;
  double zero_counts_ = 0.0;
  double jumped_counts_ = 0.0;
  double noise_counts_ = 0.0;  ///< rms
  double last_counts_ = 0.0;
  double index_turn_ = 0.0;
  double counts_at_index_ = 0.0;
  std::int64_t ticks_ = 0;
};

}  // namespace sprung::sim
