#pragma once
/// LEG_COMMAND: where the planner wants the feet, and how softly. Units and frames: lcmtypes/README.md.
/// Vectors are sized once, by the constructor, so that a step allocates nothing.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "signals/modes.h"
#include "signals/stamp.h"
#include "signals/vec3.h"

namespace sprung {

struct DesiredLeg {
  Vec3 desired_foot_in_hip_m{kNaN, kNaN, kNaN};
  Vec3 desired_foot_velocity_m_s{0, 0, 0};
  Vec3 desired_foot_acceleration_m_s2{0, 0, 0};
  Vec3 stiffness_N_m{0, 0, 0};
  Vec3 damping_N_s_m{0, 0, 0};
  Vec3 feedforward_force_N{0, 0, 0};
  double friction_compensation = 0.0;
  double velocity_feedforward = 0.0;
  double inertia_compensation = 0.0;
  Vec3 desired_joint_position_rad{kNaN, kNaN, kNaN};  ///< ControlMode::kJoint only, the leg's joints in order
  Vec3 desired_joint_velocity_rad_s{0, 0, 0};
  LegPhase phase = LegPhase::kIdle;
  ControlMode control_mode = ControlMode::kDisabled;
};

struct LegCommand {
  Stamp stamp;
  std::vector<DesiredLeg> legs;
  std::int64_t used_joint_state_seq = -1;
  LegCommand() = default;
  explicit LegCommand(std::size_t leg_count) : legs(leg_count) {}
};

}  // namespace sprung
