#pragma once
/// SAFETY_STATE: the bridge's level and its cause. Units and frames: lcmtypes/README.md.
#include <array>
#include <cstdint>

#include "signals/modes.h"
#include "signals/stamp.h"

namespace sprung {

struct SafetyState {
  Stamp stamp;
  SafetyLevel level = SafetyLevel::kDisabled;
  SafetyCause cause = SafetyCause::kStarting;
  bool latched = false;
  std::int32_t actuator = -1;
  std::int64_t since_seq = -1;
  std::int64_t commands_refused = 0;
  std::int64_t overruns = 0;
  std::int64_t missed_cycles = 0;
  std::array<char, 160> detail{};  ///< zero-terminated; fixed size so that a cycle allocates nothing
};

}  // namespace sprung
