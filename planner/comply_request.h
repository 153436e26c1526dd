#pragma once
/// What `comply` asks for, completed from the preset. Pure.
#include "robots/robot_config.h"
#include "signals/operator.h"

namespace sprung {

/// More is no virtual spring any more: the drives' own position loops give about as much at the foot.
inline constexpr double kStiffest_N_m = 1e5;
inline constexpr double kMostDamping_N_s_m = 1e4;

struct ComplyRequest {
  StiffnessConfig gains;
  double friction_compensation = 0.0;  ///< 0 to 1
};

/// Each value that the command leaves open (NaN) is the preset's.
ComplyRequest comply_request(const OperatorCommand& command, const PresetConfig& preset) noexcept;

/// Why it cannot be done, static text; nullptr: it can. The sideways axis may stay open: planar legs have
/// none.
const char* validate_comply(const OperatorCommand& command, const PresetConfig& preset) noexcept;

}  // namespace sprung
