#pragma once
/// What an operator asks, and what came of it. Units and frames: lcmtypes/README.md.
#include <cstdint>

#include "signals/modes.h"
#include "signals/stamp.h"
#include "signals/vec3.h"

namespace sprung {

struct OperatorCommand {
  Stamp stamp;
  std::int64_t request_id = 0;
  std::int64_t apply_at_seq = -1;
  OperatorKind kind = OperatorKind::kNone;
  JumpMode jump_mode = JumpMode::kHybrid;
  std::int32_t jump_count = 1;
  double jump_height_m = 0.0;
  double jump_forward_m = 0.0;           ///< where the foot lands, ahead of where it left
  Vec3 stiffness_N_m{kNaN, kNaN, kNaN};  ///< kComply; NaN: the preset's
  Vec3 damping_N_s_m{kNaN, kNaN, kNaN};  ///< kComply; NaN: the preset's
  double friction_compensation = kNaN;   ///< kComply; NaN: the preset's
  double touchdown_in_s = kNaN;          ///< kLand: from the cycle in which it takes effect
  std::int32_t actuator = -1;            ///< kHome: -1 = all
  std::int32_t joint = -1;               ///< kMoveJoint: index into the robot's joints
  double joint_target_rad = kNaN;
  double joint_speed_rad_s = kNaN;
  double joint_acceleration_rad_s2 = kNaN;
  ReferenceSource reference_source = ReferenceSource::kConfigured;
  std::int32_t gait = -1;                             ///< kWalk: index into the robot's gaits
  Vec3 walk_speed{0, 0, 0};                           ///< kWalk: forward m/s, left m/s, turning rad/s
  double body_height_m = kNaN;                        ///< kWalk; NaN: the preset's
  double stance_width_m = kNaN;                       ///< kWalk: added to each side; NaN: the preset's
  GaitControl gait_control = GaitControl::kAdaptive;  ///< kWalk
  double hold_s = kNaN;  ///< kWalk, kComply: stop so long after it took effect; kHold: so long from now; NaN:
                         ///< never
  std::int64_t parameter = 0;     ///< kSetParameter: id of which; kReadParameter: of the one before; 0: none
  double parameter_value = kNaN;  ///< kSetParameter
};

struct OperatorReply {
  Stamp stamp;
  std::int64_t request_id = 0;
  std::int64_t took_effect_at_seq = -1;
  OperatorOutcome outcome = OperatorOutcome::kRefused;
  std::int64_t parameter = 0;     ///< kSetParameter, kReadParameter: id of which; 0: none
  double parameter_value = kNaN;  ///< what it is set to now
  const char* answered_by = "";   ///< process; static text
  const char* reason = "";        ///< static text
};

}  // namespace sprung
