#pragma once
/// Inside of BridgeCore: its parts, and the rules that join them. For bridge_core.cpp and bridge_impl.cpp only.
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "drivers/bridge/bridge_core.h"
#include "drivers/bridge/command_gate.h"
#include "drivers/bridge/drive_node.h"
#include "drivers/bridge/safety_machine.h"

namespace sprung {

inline std::int64_t to_us(double seconds) noexcept {
  return static_cast<std::int64_t>(std::llround(1e6 * seconds));
}

struct BridgeCore::Impl {
  Impl(const RobotConfig& config, const BridgeOptions& bridge_options);

  void push_on_every_bus(const CanFrame& frame, FrameBatch& out) const noexcept;
  bool all_nodes(bool (*condition)(const DriveNode&)) const noexcept;
  void step_boot(std::int64_t time_us) noexcept;
  void refuse_drives(std::int64_t time_us) noexcept;
  void begin_cycle(std::int64_t time_us) noexcept;
  void recover(std::int64_t time_us) noexcept;
  void update_safety(std::int64_t time_us, bool command_due) noexcept;
  bool find_trouble(std::int64_t time_us, Trouble& out) const noexcept;
  bool any_bus_lost() const noexcept;
  double command_age_s(std::int64_t time_us, bool command_due) const noexcept;
  const char* clear(std::int64_t time_us) noexcept;
  const char* why_not_clear(std::int64_t time_us) noexcept;
  OperatorReply reply(const OperatorCommand& command, const char* refusal) noexcept;

  RobotConfig robot;
  WatchdogConfig watchdogs;
  std::int64_t cycle_us;
  std::vector<std::unique_ptr<DriveNode>> nodes;
  std::vector<std::array<DriveNode*, canopen::kMaxNode + 1>> by_bus_and_node;
  std::vector<bool> bus_lost;
  CommandGate gate;
  SafetyMachine safety;
  SafetyState published;
  DriveState state;
  Trouble bus_trouble;
  bool bus_trouble_new = false;
  bool cyclic = false;
  bool recovering = false;
  bool shutting_down = false;
  std::int64_t recover_until_us = 0;
  std::int64_t shutdown_us = 0;
  std::int64_t now_us = 0;
  std::int64_t cycle = -1;
  std::int64_t sync_us = 0;
  std::int64_t good_sync_us = 0;  ///< SYNC of the cycle that the last good command answers
  std::int64_t next_heartbeat_us = 0;
  std::int64_t overruns = 0;
  std::int64_t missed_cycles = 0;
  int overruns_in_row = 0;
  OperatorReply last_clear;
};

}  // namespace sprung
