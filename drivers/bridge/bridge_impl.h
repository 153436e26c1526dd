#pragma once
/// Inside of BridgeCore: its parts, and the rules that join them. For bridge_core.cpp, bridge_impl.cpp and
/// bridge_requests.cpp only.
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "drivers/bridge/battery_link.h"
#include "drivers/bridge/bridge_core.h"
#include "drivers/bridge/command_gate.h"
#include "drivers/bridge/drive_node.h"
#include "drivers/bridge/encoder_card_node.h"
#include "drivers/bridge/foreign_master_watch.h"
#include "drivers/bridge/hard_limit_watch.h"
#include "drivers/bridge/homing.h"
#include "drivers/bridge/recovery.h"
#include "drivers/bridge/safety_machine.h"
#include "drivers/bridge/setpoint_gate.h"
#include "signals/auxiliary_state.h"
#include "signals/bus_state.h"
#include "signals/drive_state.h"
#include "signals/microseconds.h"
#include "signals/operator.h"
#include "signals/safety_state.h"

namespace sprung {

/// An operator's request that takes a while: its last answer, for when it is asked again.
struct LongRequest {
  OperatorReply reply;
  bool answer_due = false;  ///< `reply` has changed by itself
};

struct BridgeCore::Impl {
  Impl(const RobotConfig& config, const BridgeOptions& bridge_options);

  void add(BusNode& node);
  void check_card_channels() const;  ///< @throws std::invalid_argument on one that the card has not
  void push_on_every_bus(const CanFrame& frame, FrameBatch& out) const noexcept;
  void push_heartbeats(std::int64_t time_us, FrameBatch& out) noexcept;
  void push_guarding(std::int64_t time_us, FrameBatch& out) noexcept;
  void count_sent(const FrameBatch& batch, int first) noexcept;
  void step_boot(std::int64_t time_us) noexcept;
  void refuse_nodes(std::int64_t time_us) noexcept;
  void restart_lost_nodes(std::int64_t time_us) noexcept;
  void judge_samples() noexcept;
  void judge_motion() noexcept;  ///< joints of one leg beside each other
  void emit(std::int64_t time_us, FrameBatch& out) noexcept;
  void begin_cycle(std::int64_t time_us) noexcept;
  void update_safety(std::int64_t time_us, bool command_due) noexcept;
  void emergency_stop(std::int64_t time_us, const Fault* fault) noexcept;
  void heed_emergency_inputs(std::int64_t time_us) noexcept;
  const DriveNode* stopping_input() const noexcept;  ///< whose emergency input stops now; nullptr: none
  bool find_fault(std::int64_t time_us, Fault& out) const noexcept;
  bool planner_lost(Fault& out) const noexcept;
  void show_stops(DetailText& detail) const noexcept;
  bool at_rest() const noexcept;  ///< shutting down: no drive has power any more
  void begin_restore() noexcept;
  double command_age_s(std::int64_t time_us, bool command_due) const noexcept;

  // Requests: bridge_requests.cpp.
  OperatorReply clear(const OperatorCommand& command, std::int64_t time_us) noexcept;
  OperatorReply home(const OperatorCommand& command, std::int64_t time_us) noexcept;
  void step_requests(std::int64_t time_us) noexcept;
  void doubt_lost_buses() noexcept;
  bool any_bus_loss() const noexcept;
  void finish_clear(Recovery::Result result, std::int64_t time_us) noexcept;
  void answer(LongRequest& request, OperatorOutcome outcome, const char* reason) noexcept;
  const char* why_not_clear(std::int64_t time_us) const noexcept;
  const char* why_not_home() const noexcept;
  bool enabling() const noexcept;
  OperatorReply reply(const OperatorCommand& command, const char* refusal) const noexcept;

  template <class Condition>
  bool all_links(Condition condition) const noexcept {
    for (const BusNode* node : nodes) {
      if (!condition(node->link())) return false;
    }
    return true;
  }
  template <class Condition>
  bool all_drives(Condition condition) const noexcept {
    for (const auto& drive : drives) {
      if (!condition(*drive)) return false;
    }
    return true;
  }

  RobotConfig robot;
  WatchdogConfig watchdogs;
  std::int64_t cycle_us;
  std::vector<std::unique_ptr<DriveNode>> drives;
  std::vector<std::unique_ptr<EncoderCardNode>> cards;
  std::vector<BusNode*> nodes;  ///< drives, then cards
  std::vector<std::array<BusNode*, canopen::kMaxNode + 1>> by_bus_and_node;
  BatteryLink battery;
  AuxiliaryState auxiliary;
  BusMonitor buses;
  ForeignMasterWatch masters;
  CommandGate gate;
  SetpointGate setpoints;
  HardLimitWatch limits;
  SafetyMachine safety;
  SafetyState published;
  Fault node_trouble, planner_trouble;  ///< found by update_safety(); kept, so that no cycle clears texts
  DetailText boot_text{};               ///< of boot_detail()
  DriveState state;
  std::vector<GateMotion> motion;           ///< of the drives in this cycle
  std::vector<ActuatorCommand> set_points;  ///< of the last command, as the gate lets them pass
  BusState bus_state;
  std::unique_ptr<Recovery> recovery;
  std::unique_ptr<Homing> homing;
  LongRequest last_clear;
  LongRequest last_home;
  bool clear_without_work = false;
  std::int64_t homings = 0;
  bool cyclic = false;
  bool shutting_down = false;
  std::int64_t shutdown_us = 0;
  std::int64_t now_us = 0;
  std::int64_t cycle = -1;
  std::int64_t sync_us = 0;
  std::int64_t good_sync_us = 0;  ///< SYNC of the cycle that the last good command answers
  std::int64_t next_heartbeat_us = 0;
  std::int64_t overruns = 0;
  std::int64_t missed_cycles = 0;
  int overruns_in_row = 0;
};

}  // namespace sprung
