#pragma once
/// What one node's heartbeats say: its NMT state, whether it has left operation by itself, and whether they
/// still come. Pure; stepped by time.
#include <cstdint>

#include "drivers/canopen/nmt.h"
#include "robots/robot_config.h"
#include "signals/bus_state.h"
#include "signals/microseconds.h"

namespace sprung {

class HeartbeatWatch {
 public:
  explicit HeartbeatWatch(const WatchdogConfig& watchdogs) noexcept
      : period_s_(watchdogs.heartbeat_s), longest_pause_us_(to_us(watchdogs.drive_heartbeat_s)) {}

  /// The node has been brought into operation, and was heard: from now on heartbeats are due.
  void begin_operation(std::int64_t time_us) noexcept;
  /// @param in_operation the node is in operation as far as the bridge knows: what else it says is its own
  /// doing.
  /// @return whether the state is the node's word: not another tool's guard request, nor one of before its
  ///         start that comes late.
  bool receive(canopen::NmtState state, std::int64_t time_us, bool in_operation) noexcept;
  /// Counts a loss when it begins.
  void watch(std::int64_t time_us, bool in_operation) noexcept;
  /// Its communication is reset: what it did before is forgotten.
  void restart() noexcept { rebooted_ = lost_ = false; }

  bool missing(std::int64_t time_us) const noexcept;
  bool rebooted() const noexcept { return rebooted_; }  ///< by itself, since the last restart()
  /// Operational is the last that it has said.
  bool operational() const noexcept { return state_ == canopen::NmtState::kOperational && !rebooted_; }
  /// Its newest word; a boot-up stays the word until restart().
  canopen::NmtState word() const noexcept { return rebooted_ ? canopen::NmtState::kBootUp : state_; }
  /// Losses and NMT state.
  void show(NodeHealth& out) const noexcept;

 private:
  double period_s_;
  std::int64_t longest_pause_us_;
  canopen::NmtState state_ = canopen::NmtState::kUnknown;
  std::int64_t operational_us_ = 0;
  std::int64_t heard_us_ = 0;
  bool rebooted_ = false;
  bool lost_ = false;
  std::int64_t losses_ = 0;
};

}  // namespace sprung
