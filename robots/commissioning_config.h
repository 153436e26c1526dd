#pragma once
/// What must be right in a drive before it is first used and that the bridge does not write at each start:
/// `commissioning` of an actuator in robot.yaml. `sprung drive commission` compares; nothing in the loop
/// reads it.
#include <cstdint>

namespace sprung {

enum class MotorKind : std::int8_t {
  kBrushless,  ///< sinusoidal or block, whichever the drive has
  kSinusoidal,
  kBlock,
  kBrushed,
};

struct CommissioningConfig {
  MotorKind motor = MotorKind::kBrushless;
  bool encoder_inverted = false;  ///< polarity that the drive must be told, as the encoder is wired
  int current_p = 0;  ///< current regulator, the maker's own units; 0, 0 = only that they are plausible
  int current_i = 0;
  bool brake = false;  ///< a brake holds the motor without power
};

}  // namespace sprung
