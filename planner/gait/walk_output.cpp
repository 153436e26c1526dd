#include "model/leg_kinematics.h"
#include "planner/gait/walk.h"

namespace sprung {

bool Walk::on_spring(std::size_t leg) const noexcept {
  const LegStep& step = steps_[leg];
  if (step.stands() || step.control() == GaitControl::kForce) return true;
  return step.control() == GaitControl::kPreStance && step.phase() == LegPhase::kPreStance;
}

void Walk::write(std::size_t leg, DesiredLeg& out) const noexcept {
  const LegStep& step = steps_[leg];
  const Eigen::Matrix3d trunk_from_level = view_.level_from_trunk.transpose();
  // A standing foot is wanted where it would be under a trunk that lies along the ground: its spring then
  // turns the trunk so. A swinging one is led over the ground as it lies.
  const Eigen::Matrix3d as_wanted = step.stands() ? Eigen::Matrix3d(level_from_ground_.transpose())
                                                  : trunk_from_level;
  out.phase = step.phase();
  out.desired_foot_in_hip_m = to_vec3(as_wanted * step.wanted_m() - shape_.hip_in_trunk_m[leg]);
  out.desired_foot_velocity_m_s = to_vec3(as_wanted * step.wanted_m_s());
  out.desired_foot_acceleration_m_s2 = to_vec3(as_wanted * step.wanted_m_s2());
  if (!on_spring(leg)) {
    out.control_mode = ControlMode::kPosition;
    out.friction_compensation = law_.swing_friction_compensation;
    out.inertia_compensation = law_.swing_inertia_compensation;
    return;
  }
  const StiffnessConfig& gains = step.stands() ? law_.stance
                                 : step.phase() == LegPhase::kPreStance &&
                                         step.control() == GaitControl::kPreStance
                                     ? law_.pre_stance
                                     : law_.swing;
  out.control_mode = ControlMode::kCompliance;
  out.stiffness_N_m = gains.stiffness_N_m;
  out.damping_N_s_m = gains.damping_N_s_m;
  out.velocity_feedforward = gains.velocity_feedforward;
  out.feedforward_force_N = to_vec3(trunk_from_level * force_N_[leg]);
  out.friction_compensation = step.stands() ? (gait().duty < 1.0 ? stance_friction_ : standing_friction_)
                                            : law_.swing_friction_compensation;
  // S1's virtual springs have none. In a swing on one, which is there to compare with, it is what a position
  // loop gets.
  const bool swings = !step.stands() && step.control() == GaitControl::kForce;
  out.inertia_compensation = swings ? law_.swing_inertia_compensation : 0.0;
}

void Walk::write(MotionState& out) const noexcept {
  out.gait = ended_ ? -1 : now_.gait;
  out.gait_phase = ended_ ? 0.0 : clock_.phase();
  out.desired_speed = desired_speed();
  for (std::size_t i = 0; i < out.legs.size() && i < shape_.legs; ++i) {
    out.legs[i] = {steps_[i].phase(),
                   steps_[i].in_phase_s(),
                   steps_[i].last_event(),
                   steps_[i].counts(),
                   ground_.expected_z_m(view_.foot_m[i]) - shape_.foot_radius_m[i],
                   ground_.z_bound_m()};
  }
  out.estimated_ground_slope = {ground_.slope().x(), ground_.slope().y()};
  const Eigen::Vector2d bound = ground_.slope_bound();
  out.estimated_ground_slope_bound = {bound.x(), bound.y()};
}

}  // namespace sprung
