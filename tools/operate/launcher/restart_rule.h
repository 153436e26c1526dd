#pragma once
/// Whether a process that ended by itself is started again. Pure. Torque never comes back by a restart: what
/// commands drives waits until the bridge says that no drive has power, and the bridge itself gives power
/// only after somebody said `stand`.
#include <cstdint>
#include <optional>

#include "robots/robot_config.h"

namespace sprung {

/// What the bridge said last of its drives.
struct TorqueHeard {
  bool any = true;            ///< a drive has torque, or may have
  std::int64_t utime_us = 0;  ///< of that DRIVE_STATE
};

struct EndedProcess {
  RestartPolicy policy = RestartPolicy::kNever;
  /// Commands nothing (the recorder): is started again at once where a signal ended it. Where it ended by
  /// itself it has said why (the disk is nearly full, its file cannot be written), and would soon end again.
  bool harmless = false;
  bool lockstep = false;  ///< a deterministic run ends with any of its processes
  int restarts = 0;       ///< so far
  std::int64_t ended_utime_us = 0;
  bool by_signal = false;  ///< killed, not by its own exit
};

class RestartRule {
 public:
  static constexpr int kMost = 3;  ///< of one process in one run: what dies again and again is broken
  static constexpr std::int64_t kSettle_us = 300'000;  ///< the bridge has seen what the end brought
  static constexpr std::int64_t kFresh_us = 500'000;   ///< DRIVE_STATE comes in every cycle

  /// May still be started again, now or later.
  static bool hopeful(const EndedProcess& ended) noexcept;
  static bool due(const EndedProcess& ended, const std::optional<TorqueHeard>& torque,
                  std::int64_t now_us) noexcept;
};

}  // namespace sprung
