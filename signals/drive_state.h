#pragma once
/// DRIVE_STATE: what the drives measured in a cycle. Units and frames: lcmtypes/README.md. Vectors are sized
/// once, by the constructor, so that a step allocates nothing.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "signals/modes.h"
#include "signals/stamp.h"
#include "signals/vec3.h"

namespace sprung {

struct ActuatorState {
  double measured_position_rad = kNaN;       ///< output side of the gear, sign and offset applied
  double measured_link_position_rad = kNaN;  ///< NaN where there is no link encoder
  double measured_velocity_rad_s = kNaN;     ///< NaN unless the drive sends it
  double measured_current_A = kNaN;
  double measured_supply_V = kNaN;
  std::int32_t fault_code = 0;
  std::int32_t age_cycles = 0;
  PowerState power_state = PowerState::kUnknown;
  DriveMode shown_mode = DriveMode::kDisabled;
  bool referenced = false;
};

struct DriveState {
  Stamp stamp;
  std::vector<ActuatorState> actuators;
  SafetyLevel safety = SafetyLevel::kDisabled;
  DriveState() = default;
  explicit DriveState(std::size_t actuator_count) : actuators(actuator_count) {}
};

}  // namespace sprung
