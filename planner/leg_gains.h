#pragma once
/// Which control a leg is under in each part of a jump, and with which gains. Pure.
#include "robots/robot_config.h"
#include "signals/signals.h"

namespace sprung {

/// Where a jump stands.
struct JumpProgress {
  MotionPhase phase = MotionPhase::kIdle;
  JumpMode mode = JumpMode::kHybrid;
  double in_phase_s = 0.0;
  double since_thrust_s = 0.0;
};

/// position: the drives' position loops throughout. torque: compliance from the end of the crouch's move (the
/// settling before the thrust takes up the change) through landing. hybrid: position until hybrid_switch
/// after the thrust began or until touchdown, whichever is first, then compliance.
bool compliant(const JumpProgress& jump, const PresetConfig& preset) noexcept;

/// Fills mode and gains of `out` from the above.
void set_control(const JumpProgress& jump, const PresetConfig& preset, DesiredLeg& out) noexcept;

}  // namespace sprung
