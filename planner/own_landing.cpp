#include "planner/own_landing.h"

namespace sprung {

OwnLanding::OwnLanding(const RobotConfig& /*robot*/, const LegConfig& /*leg*/, const PresetConfig& preset)
    : preset_(preset) {}

void OwnLanding::begin(const ExpectedTouchdown& expected) noexcept { expected_ = expected; }

OwnLandingOutput OwnLanding::step(const OwnLandingInput& in) noexcept {
  DesiredLeg leg;
  set_control(in.progress, preset_, leg);
  OwnLandingOutput out;
  out.desired = in.planned;
  out.control_mode = leg.control_mode;
  out.gains = {leg.stiffness_N_m, leg.damping_N_s_m, leg.velocity_feedforward};
  out.feedforward_force_N = leg.feedforward_force_N;
  out.friction_compensation = leg.friction_compensation;
  out.inertia_compensation = leg.inertia_compensation;
  return out;
}

}  // namespace sprung
