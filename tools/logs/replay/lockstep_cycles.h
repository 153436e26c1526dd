#pragma once
/// Where a log of a run in which everybody waits for everybody shows that somebody did not: cycles that were
/// made from older messages than their own, and messages that nobody made. Pure.
#include <array>
#include <cstddef>
#include <cstdint>

#include "tools/logs/log/cycle_stretches.h"
#include "tools/logs/replay/log_cycles.h"

namespace sprung {

/// Of one channel.
struct AbsentCycles {
  log::CycleStretches never_made;  ///< the leg controller, which waits for it, went on with an older one
  log::CycleStretches not_in_log;  ///< it was lost, or never made: nothing in the log says which
};

struct LockstepFlaws {
  /// LEG_COMMAND and MOTION_STATE are made together.
  static constexpr std::array<const char*, 4> kChannels{"JOINT_STATE", "LEG_COMMAND", "MOTION_STATE",
                                                        "DRIVE_COMMAND"};
  log::CycleStretches older;           ///< DRIVE_COMMANDs, by signals/own_inputs.h
  log::CycleStretches without_answer;  ///< the bridge went on without one, of drives or leg controller
  std::array<AbsentCycles, kChannels.size()> absent;

  /// Nothing was made from older messages, or never, or did without an answer.
  bool deterministic() const noexcept;
  bool every_message() const noexcept;  ///< no channel misses any
};

class LockstepCycles {
 public:
  /// In the order of LogCycles.
  void add(const LoggedCycle& cycle);
  const LockstepFlaws& flaws() const noexcept { return flaws_; }

 private:
  void begin_anew() noexcept;
  void add_command(const Bytes& drive_command);
  void add_message(std::size_t channel, std::int64_t seq);
  bool was_never_made(std::size_t channel, std::int64_t first, std::int64_t last) const noexcept;

  LockstepFlaws flaws_;
  std::array<std::int64_t, LockstepFlaws::kChannels.size()> newest_{-1, -1, -1, -1};
  log::CycleStretches without_joint_state_;  ///< DRIVE_COMMANDs made from an older one than their own
  log::CycleStretches without_leg_command_;
};

}  // namespace sprung
