#include "planner/leg_gains.h"

namespace sprung {

bool compliant(const JumpProgress& jump, const PresetConfig& preset) noexcept {
  const bool airborne_or_pushing = jump.phase == MotionPhase::kThrust || jump.phase == MotionPhase::kFlight;
  const bool landing = jump.phase == MotionPhase::kLanding;
  switch (jump.mode) {
    case JumpMode::kPosition:
      return false;
    case JumpMode::kTorque:
      return airborne_or_pushing || landing ||
             (jump.phase == MotionPhase::kCrouch && jump.in_phase_s >= preset.crouch_time_s);
    case JumpMode::kHybrid:
    case JumpMode::kAdaptive:
      return landing || (airborne_or_pushing && jump.since_thrust_s >= jump.hybrid_switch_s);
  }
  return false;
}

void set_compliance(const StiffnessConfig& gains, double friction_compensation, const PresetConfig& preset,
                    DesiredLeg& out) noexcept {
  out.control_mode = ControlMode::kCompliance;
  out.stiffness_N_m = gains.stiffness_N_m;
  out.damping_N_s_m = gains.damping_N_s_m;
  out.velocity_feedforward = gains.velocity_feedforward;
  out.feedforward_force_N = {0.0, 0.0, 0.0};
  out.friction_compensation = friction_compensation;
  out.inertia_compensation = preset.inertia_compensation;
}

void set_control(const JumpProgress& jump, const PresetConfig& preset, DesiredLeg& out) noexcept {
  if (compliant(jump, preset)) {
    const StiffnessConfig& gains = jump.mode == JumpMode::kTorque ? preset.torque_jump
                                                                  : preset.hybrid_landing;
    return set_compliance(gains, preset.friction_compensation, preset, out);
  }
  out.feedforward_force_N = {0.0, 0.0, 0.0};
  out.friction_compensation = preset.friction_compensation;
  out.control_mode = ControlMode::kPosition;
  out.stiffness_N_m = out.damping_N_s_m = {0.0, 0.0, 0.0};
  out.velocity_feedforward = 0.0;
}

}  // namespace sprung
