#include "planner/motion.h"

/// What a motion says: LEG_COMMAND and MOTION_STATE.
namespace sprung {
namespace {

LegPhase leg_phase(MotionPhase phase) noexcept {
  switch (phase) {
    case MotionPhase::kIdle:
    case MotionPhase::kFallen:
    case MotionPhase::kMovingJoint:
      return LegPhase::kIdle;
    case MotionPhase::kRising:
    case MotionPhase::kStanding:
    case MotionPhase::kSitting:
    case MotionPhase::kComplying:
    case MotionPhase::kWalking:  // each leg has its own: Walk writes it
      return LegPhase::kStand;
    case MotionPhase::kCrouch:
      return LegPhase::kCrouch;
    case MotionPhase::kThrust:
      return LegPhase::kThrust;
    case MotionPhase::kFlight:
      return LegPhase::kFlight;
    case MotionPhase::kLanding:
      return LegPhase::kLanding;
    case MotionPhase::kRecover:
      return LegPhase::kRecover;
  }
  return LegPhase::kIdle;
}

}  // namespace

const char* Motion::last_transition() const noexcept {
  const bool failing = state() == MotionPhase::kWalking && walk_.failure() != nullptr;
  if (failing || walk_failed_) return walk_.failure();
  if (reflex_.acts()) return "a fall is coming: legs fold and spring";
  return machine_.last() != nullptr ? machine_.last()->reason : "";
}

void Motion::write(const JointState& in, LegCommand& out) noexcept {
  out.stamp = in.stamp;
  out.used_joint_state_seq = in.stamp.seq;
  for (std::size_t i = 0; i < out.legs.size(); ++i) {
    DesiredLeg& leg = out.legs[i];
    leg = DesiredLeg{};
    leg.phase = leg_phase(state());
    if (state() == MotionPhase::kMovingJoint) {
      joints_.write(i, now_us_, leg);
    } else if (state() == MotionPhase::kWalking) {
      walk_.write(i, leg);
    } else if (reflex_.acts()) {
      reflex_.write(i, leg);
      continue;
    } else if (lands_adaptively()) {
      write_adaptive_landing(i, in, leg);
    } else {
      write_foot(i, in, leg);
    }
    if (sinking() || state() == MotionPhase::kFallen) leg.control_mode = ControlMode::kDamping;
  }
}

void Motion::write_foot(std::size_t leg, const JointState& in, DesiredLeg& out) const noexcept {
  const FootPoint foot = waiting() || state() == MotionPhase::kIdle
                             ? FootPoint{in.legs[leg].estimated_foot_in_hip_m, {}, {}}
                             : path(leg);
  out.desired_foot_in_hip_m = foot.position_m;
  out.desired_foot_velocity_m_s = foot.velocity_m_s;
  out.desired_foot_acceleration_m_s2 = foot.acceleration_m_s2;
  if (state() == MotionPhase::kComplying) {
    set_compliance(compliance_.gains, compliance_.friction_compensation, preset_, out);
  } else if (state() != MotionPhase::kIdle) {
    set_control(progress(), preset_, out);
  }
}

void Motion::write_adaptive_landing(std::size_t leg, const JointState& in, DesiredLeg& out) noexcept {
  const AdaptiveLandingOutput& adaptive = adaptive_said_[leg] = adaptive_landing_[leg].step(
      {now_us_, path(leg), progress(), in.legs[leg]});
  out.desired_foot_in_hip_m = adaptive.desired.position_m;
  out.desired_foot_velocity_m_s = adaptive.desired.velocity_m_s;
  out.desired_foot_acceleration_m_s2 = adaptive.desired.acceleration_m_s2;
  out.control_mode = adaptive.control_mode;
  out.stiffness_N_m = adaptive.gains.stiffness_N_m;
  out.damping_N_s_m = adaptive.gains.damping_N_s_m;
  out.velocity_feedforward = adaptive.gains.velocity_feedforward;
  out.feedforward_force_N = adaptive.feedforward_force_N;
  out.friction_compensation = adaptive.friction_compensation;
  out.inertia_compensation = adaptive.inertia_compensation;
}

void Motion::write(MotionState& out) const noexcept {
  out.state = state();
  for (MotionLeg& leg : out.legs) leg = {leg_phase(state()), in_phase_s(), LegEvent::kNone, {}, kNaN, kNaN};
  out.gait = -1;
  out.gait_phase = 0.0;
  out.desired_speed = {};
  out.estimated_ground_slope = out.estimated_ground_slope_bound = {kNaN, kNaN};
  out.payload = payload_.estimate();
  if (state() == MotionPhase::kWalking) walk_.write(out);
  out.jumps_done = jump_.done();
  out.jumps_left = jump_.left();
  out.jump_height_scale = jump_.curve().factor();
  out.estimated_jump_height_m = jump_.estimated_height_m();
  out.jump_mode = jump_.mode();
  out.last_transition = last_transition();
}

}  // namespace sprung
