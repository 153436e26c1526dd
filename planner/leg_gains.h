#pragma once
/// Which control a leg is under in each part of a jump, and with which gains. Pure.
#include "robots/robot_config.h"
#include "signals/leg_command.h"

namespace sprung {

/// Where a jump or a fall stands.
struct JumpProgress {
  MotionPhase phase = MotionPhase::kIdle;
  JumpMode mode = JumpMode::kHybrid;
  double in_phase_s = 0.0;
  double since_thrust_s = 0.0;   ///< or since the fall began
  double hybrid_switch_s = 0.0;  ///< hybrid: compliance from then on, the same clock
};

/// position: the drives' position loops throughout. torque: compliance from the end of the crouch's move (the
/// settling before the thrust takes up the change) through landing. hybrid: position until hybrid_switch_s
/// or until touchdown, whichever is first, then compliance.
bool compliant(const JumpProgress& jump, const PresetConfig& preset) noexcept;

/// The foot on a virtual spring.
void set_compliance(const StiffnessConfig& gains, double friction_compensation, const PresetConfig& preset,
                    DesiredLeg& out) noexcept;

/// Fills mode and gains of `out` from the above.
void set_control(const JumpProgress& jump, const PresetConfig& preset, DesiredLeg& out) noexcept;

}  // namespace sprung
