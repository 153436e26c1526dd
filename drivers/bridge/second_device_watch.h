#pragma once
/// Whether two devices answer to one node id: by two different answers to one SYNC, or by a node that says
/// that it has left operation and goes on answering. Pure; stepped by cycles.
#include <bitset>
#include <cstdint>

#include "drivers/canopen/nmt.h"

namespace sprung {

class SecondDeviceWatch {
 public:
  /// @param heartbeat_s period of the nodes' heartbeats.
  explicit SecondDeviceWatch(double heartbeat_s) noexcept : heartbeat_s_(heartbeat_s) {}

  void begin_cycle() noexcept;
  /// This SYNC has two answers that differ.
  void conflict() noexcept { conflict_ = true; }
  /// What a node that should be in operation says that it is. @param owed answers to earlier SYNCs that may
  /// still come.
  void said(canopen::NmtState state, int owed) noexcept;
  /// At the end of a cycle. @param rebooted the node has said that it booted by itself.
  void judge(bool answered, std::int64_t sync_us, bool rebooted) noexcept;
  void restart() noexcept;

  bool found() const noexcept { return found_; }  ///< until restart()

 private:
  double heartbeat_s_;
  bool conflict_ = false;
  std::bitset<10> conflicts_;  ///< of the last cycles
  bool left_ = false;          ///< it says so; not yet known whether its answers agree
  int answers_since_left_ = 0;
  int contradictions_ = 0;  ///< it said that it had left operation, and went on answering
  std::int64_t contradiction_us_ = 0;
  bool found_ = false;
};

}  // namespace sprung
