#pragma once
/// DRIVE_COMMAND: what the drives shall do. Units and frames: lcmtypes/README.md. Vectors are sized once, by
/// the constructor, so that a step allocates nothing.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "signals/modes.h"
#include "signals/stamp.h"
#include "signals/vec3.h"

namespace sprung {

struct ActuatorCommand {
  double commanded_torque_Nm = 0.0;
  double commanded_position_rad = kNaN;
  double commanded_velocity_rad_s = 0.0;
  double commanded_damping_Nm_s_rad = 0.0;
  DriveMode mode = DriveMode::kDisabled;
};

struct DriveCommand {
  Stamp stamp;
  std::vector<ActuatorCommand> actuators;
  std::int64_t valid_until_utime_us = 0;
  std::int64_t used_joint_state_seq = -1;
  std::int64_t used_leg_command_seq = -1;
  DriveCommand() = default;
  explicit DriveCommand(std::size_t actuator_count) : actuators(actuator_count) {}
};

}  // namespace sprung
