#include "planner/motion.h"

/// What a motion says: LEG_COMMAND and MOTION_STATE.
namespace sprung {
namespace {

LegPhase leg_phase(MotionPhase phase) noexcept {
  switch (phase) {
    case MotionPhase::kIdle:
    case MotionPhase::kMovingJoint:
      return LegPhase::kIdle;
    case MotionPhase::kRising:
    case MotionPhase::kStanding:
    case MotionPhase::kSitting:
    case MotionPhase::kComplying:
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

void Motion::write(const JointState& in, LegCommand& out) const noexcept {
  out.stamp = in.stamp;
  out.used_joint_state_seq = in.stamp.seq;
  for (std::size_t i = 0; i < out.legs.size(); ++i) {
    DesiredLeg& leg = out.legs[i];
    leg = DesiredLeg{};
    leg.phase = leg_phase(state());
    if (state() == MotionPhase::kMovingJoint) {
      joints_.write(i, now_us_, leg);
    } else {
      write_foot(i, in, leg);
    }
    if (sinking()) leg.control_mode = ControlMode::kDamping;
  }
}

void Motion::write_foot(std::size_t leg, const JointState& in, DesiredLeg& out) const noexcept {
  const FootPoint foot = waiting() || state() == MotionPhase::kIdle
                             ? FootPoint{in.legs[leg].estimated_foot_in_hip_m, {}, {}}
                             : path(leg);
  out.desired_foot_in_hip_m = foot.position_m;
  out.desired_foot_velocity_m_s = foot.velocity_m_s;
  out.desired_foot_acceleration_m_s2 = foot.acceleration_m_s2;
  if (state() != MotionPhase::kIdle) set_control(progress(), preset_, out);
}

void Motion::write(MotionState& out) const noexcept {
  out.state = state();
  for (MotionLeg& leg : out.legs) leg = {leg_phase(state()), in_phase_s()};
  out.jumps_done = jumps_done_;
  out.jumps_left = jumps_left_;
  out.jump_height_scale = curve_.factor();
  out.jump_mode = request_.mode;
  out.last_transition = last_transition();
}

}  // namespace sprung
