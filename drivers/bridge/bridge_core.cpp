#include "drivers/bridge/bridge_core.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "drivers/bridge/command_gate.h"
#include "drivers/bridge/drive_node.h"
#include "drivers/bridge/safety_machine.h"
#include "drivers/can/can_errors.h"

namespace sprung {
namespace {

constexpr std::int64_t kRecovery_us =
    300'000;                         // [design choice] for fault resets after start and after clear
constexpr double kSlow_rad_s = 0.1;  // [design choice] nearly at rest
constexpr std::int64_t kShutdownLimit_us =
    2'000'000;  // then the process may end although a drive still shows power

std::int64_t to_us(double seconds) noexcept { return static_cast<std::int64_t>(std::llround(1e6 * seconds)); }

}  // namespace

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
  double command_age_s(bool command_due) const noexcept;
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

BridgeCore::Impl::Impl(const RobotConfig& config, const BridgeOptions& bridge_options)
    : robot(config),
      watchdogs(bridge_options.watchdogs),
      cycle_us(to_us(config.cycle_s)),
      by_bus_and_node(config.buses.size()),
      bus_lost(config.buses.size(), false),
      gate(config),
      safety(bridge_options.watchdogs),
      state(config.actuators.size()) {
  for (const ActuatorConfig& actuator : robot.actuators) {
    const bool exists = actuator.bus >= 0 && static_cast<std::size_t>(actuator.bus) < robot.buses.size() &&
                        actuator.node > 0 && actuator.node < canopen::kBridgeNode;
    if (!exists) throw std::invalid_argument("actuator '" + actuator.name + "': no such bus or node");
    nodes.push_back(std::make_unique<DriveNode>(actuator, robot.cycle_s, watchdogs));
    by_bus_and_node[static_cast<std::size_t>(actuator.bus)][static_cast<std::size_t>(actuator.node)] =
        nodes.back().get();
  }
  last_clear.request_id = -1;
}

void BridgeCore::Impl::push_on_every_bus(const CanFrame& frame, FrameBatch& out) const noexcept {
  for (std::size_t bus = 0; bus < robot.buses.size(); ++bus) out.push(static_cast<int>(bus), frame);
}

bool BridgeCore::Impl::all_nodes(bool (*condition)(const DriveNode&)) const noexcept {
  return std::all_of(nodes.begin(), nodes.end(), [condition](const auto& node) { return condition(*node); });
}

/// NMT start goes out when every drive is configured; one that boots again in operation finds the others
/// started.
void BridgeCore::Impl::step_boot(std::int64_t time_us) noexcept {
  refuse_drives(time_us);
  const bool ready =
      all_nodes([](const DriveNode& node) { return node.boot().configured() || node.boot().started(); });
  if (!ready) return;
  for (auto& node : nodes) node->start();
}

void BridgeCore::Impl::refuse_drives(std::int64_t time_us) noexcept {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const NodeBoot& boot = nodes[i]->boot();
    if (boot.refused()) {
      safety.refuse_drive({SafetyCause::kDriveRefused, static_cast<int>(i), boot.detail()}, time_us, cycle);
    }
  }
}

/// Drives often come up with a fault (facts canopen 2.5), so cyclic operation begins with resetting them.
void BridgeCore::Impl::begin_cycle(std::int64_t time_us) noexcept {
  if (!cyclic) recover(time_us);
  cyclic = true;
  ++cycle;
}

void BridgeCore::Impl::recover(std::int64_t time_us) noexcept {
  recovering = true;
  recover_until_us = time_us + kRecovery_us;
}

double BridgeCore::Impl::command_age_s(bool command_due) const noexcept {
  if (!gate.any()) return 0.0;
  const std::int64_t age_us = sync_us - good_sync_us - (command_due ? 0 : cycle_us);
  return 1e-6 * static_cast<double>(std::max<std::int64_t>(age_us, 0));
}

bool BridgeCore::Impl::find_trouble(std::int64_t time_us, Trouble& out) const noexcept {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    out.actuator = static_cast<int>(i);
    if (nodes[i]->trouble(time_us, recovering, out)) return true;
  }
  return false;
}

void BridgeCore::Impl::update_safety(std::int64_t time_us, bool command_due) noexcept {
  if (recovering) {
    for (auto& node : nodes) node->reset_faults(true);
    recovering =
        time_us < recover_until_us && !all_nodes([](const DriveNode& node) { return !node.faulted(); });
    if (!recovering) {
      for (auto& node : nodes) node->reset_faults(false);
    }
  }
  Trouble drive_trouble;
  SafetyInputs inputs;
  inputs.time_us = time_us;
  inputs.cycle = cycle;
  inputs.armed = gate.armed() && !recovering;
  inputs.command_age_s = command_age_s(command_due);
  inputs.command_refused = gate.last_was_refused();
  inputs.refusal = &gate.detail();
  inputs.drive = !safety.latched() && find_trouble(time_us, drive_trouble) ? &drive_trouble : nullptr;
  inputs.bus = bus_trouble_new ? &bus_trouble : nullptr;
  inputs.overruns_in_row = overruns_in_row;
  inputs.slow =
      all_nodes([](const DriveNode& n) { return std::abs(n.filtered_velocity_rad_s()) < kSlow_rad_s; });
  safety.update(inputs);
  bus_trouble_new = false;
  if (safety.latched()) gate.disarm();
}

const char* BridgeCore::Impl::why_not_clear(std::int64_t time_us) noexcept {
  if (shutting_down) return "the bridge is shutting down";
  if (std::find(bus_lost.begin(), bus_lost.end(), true) != bus_lost.end())
    return "a bus is lost; see SAFETY_STATE";
  bool booting = false;
  for (auto& node : nodes) {
    if (!node->lost(time_us)) continue;
    booting = true;
    if (node->boot().operational()) node->restart();
  }
  if (booting) return "a drive is not operational; it is being configured again, then clear once more";
  for (auto& node : nodes) {
    if (node->silent()) return "a drive does not answer";
    if (node->powered()) return "drives are still stopping";
  }
  const bool by_command =
      safety.cause() == SafetyCause::kCommandStale || safety.cause() == SafetyCause::kCommandRefused;
  if (by_command && command_age_s(false) > watchdogs.command_hold_s)
    return "no good DRIVE_COMMAND is coming in";
  return nullptr;
}

/// @return nullptr when cleared, else why not.
const char* BridgeCore::Impl::clear(std::int64_t time_us) noexcept {
  if (!safety.latched()) return nullptr;
  if (cyclic) {
    const char* refusal = why_not_clear(time_us);
    if (refusal != nullptr) return refusal;
  }
  for (auto& node : nodes) {
    if (node->boot().refused()) node->restart();
  }
  gate.disarm();
  safety.clear(time_us, cycle);
  recover(time_us);
  return nullptr;
}

OperatorReply BridgeCore::Impl::reply(const OperatorCommand& command, const char* refusal) noexcept {
  OperatorReply answer;
  answer.stamp = {now_us, cycle};
  answer.request_id = command.request_id;
  answer.from = "bridge";
  answer.outcome = refusal == nullptr ? OperatorOutcome::kAccepted : OperatorOutcome::kRefused;
  answer.reason = refusal == nullptr ? "" : refusal;
  answer.took_effect_at_seq = refusal == nullptr ? cycle : -1;
  return answer;
}

BridgeCore::BridgeCore(const RobotConfig& robot, const BridgeOptions& options)
    : impl_(std::make_unique<Impl>(robot, options)) {}
BridgeCore::~BridgeCore() = default;

void BridgeCore::begin_tick(std::int64_t time_us, FrameBatch& out) noexcept {
  Impl& s = *impl_;
  s.now_us = time_us;
  s.step_boot(time_us);
  for (auto& node : s.nodes) node->step(time_us, out);
  if (time_us + s.cycle_us > s.next_heartbeat_us) {  // rather early than late for the drives' consumers
    s.next_heartbeat_us = time_us + to_us(s.watchdogs.heartbeat_s);
    s.push_on_every_bus(canopen::heartbeat_frame(canopen::kBridgeNode, canopen::NmtState::kOperational), out);
  }
  s.sync_us = time_us;
  for (auto& node : s.nodes) node->begin_sampling(time_us);
  s.push_on_every_bus(canopen::sync_frame(), out);
}

void BridgeCore::receive(int bus, const CanFrame& frame, std::int64_t time_us) noexcept {
  Impl& s = *impl_;
  if (bus < 0 || static_cast<std::size_t>(bus) >= s.bus_lost.size()) return;
  const auto at = static_cast<std::size_t>(bus);
  if (tells_bus_lost(frame)) {
    s.bus_lost[at] = true;
    s.bus_trouble_new = true;
    s.bus_trouble.cause = SafetyCause::kBusLost;
    print(s.bus_trouble.detail, "bus %s (%s) is lost", s.robot.buses[at].name.c_str(),
          s.robot.buses[at].can.c_str());
    return;
  }
  if (tells_bus_restarted(frame)) s.bus_lost[at] = false;
  if (frame.error) return;
  s.bus_lost[at] = false;  // what arrives shows that the bus works
  DriveNode* node = s.by_bus_and_node[at][frame.id & 0x7F];
  if (node != nullptr) node->receive(frame, time_us);
}

bool BridgeCore::all_answered() const noexcept {
  return impl_->all_nodes([](const DriveNode& node) { return !node.boot().started() || node.answered(); });
}

bool BridgeCore::end_sampling(std::int64_t time_us, DriveState& out) noexcept {
  Impl& s = *impl_;
  s.now_us = time_us;
  const bool all_sampled =
      s.all_nodes([](const DriveNode& n) { return n.boot().operational() && n.answered(); });
  if (!s.cyclic && !all_sampled) return false;
  s.begin_cycle(time_us);
  for (auto& node : s.nodes) node->end_sampling();
  s.update_safety(time_us, false);
  s.state.stamp = {s.sync_us, s.cycle};
  s.state.safety = s.safety.level();
  for (std::size_t i = 0; i < s.nodes.size(); ++i) s.nodes[i]->fill(s.state.actuators[i]);
  out.stamp = s.state.stamp;
  out.safety = s.state.safety;
  out.actuators = s.state.actuators;  // same size since construction: copies without allocating
  return true;
}

bool BridgeCore::command(const DriveCommand& command, std::int64_t time_us) noexcept {
  Impl& s = *impl_;
  if (!s.cyclic || !s.gate.accept(command, s.cycle, time_us, s.state)) return false;
  s.good_sync_us = s.sync_us - (s.cycle - command.stamp.seq) * s.cycle_us;
  return true;
}

void BridgeCore::emit_setpoints(std::int64_t time_us, FrameBatch& out) noexcept {
  Impl& s = *impl_;
  s.now_us = time_us;
  if (!s.cyclic) return;
  s.update_safety(time_us, true);
  for (std::size_t i = 0; i < s.nodes.size(); ++i) {
    s.nodes[i]->emit(time_us, s.safety.level(), s.gate.last().actuators[i], out);
  }
}

OperatorReply BridgeCore::operator_command(const OperatorCommand& command, std::int64_t time_us) noexcept {
  Impl& s = *impl_;
  s.now_us = time_us;
  if (command.kind == OperatorKind::kEstop) {
    s.safety.emergency_stop(time_us, s.cycle);
    s.gate.disarm();
    return s.reply(command, nullptr);
  }
  if (command.kind != OperatorKind::kClear) return s.reply(command, "not the bridge's request");
  if (command.request_id != s.last_clear.request_id) s.last_clear = s.reply(command, s.clear(time_us));
  return s.last_clear;  // a repeated request is answered, not executed: it might clear something newer
}

void BridgeCore::count_overrun(std::int64_t time_us) noexcept {
  impl_->now_us = time_us;
  ++impl_->overruns;
  ++impl_->overruns_in_row;
}

void BridgeCore::count_good_cycle() noexcept { impl_->overruns_in_row = 0; }

void BridgeCore::count_missed_cycle() noexcept { ++impl_->missed_cycles; }

void BridgeCore::begin_shutdown(std::int64_t time_us) noexcept {
  Impl& s = *impl_;
  if (s.shutting_down) return;
  s.shutting_down = true;
  s.shutdown_us = time_us;
  s.now_us = time_us;
  s.safety.begin_shutdown(time_us, s.cycle);
  s.gate.disarm();
}

bool BridgeCore::shut_down() const noexcept {
  const Impl& s = *impl_;
  if (!s.shutting_down) return false;
  if (!s.cyclic || s.now_us - s.shutdown_us > kShutdownLimit_us) return true;
  return s.safety.level() != SafetyLevel::kDamping &&
         s.all_nodes([](const DriveNode& n) { return !n.powered(); });
}

const SafetyState& BridgeCore::safety() const noexcept {
  Impl& s = *impl_;
  s.published = s.safety.state();
  s.published.stamp = {s.now_us, s.cycle};
  s.published.commands_refused = s.gate.refused();
  s.published.overruns = s.overruns;
  s.published.missed_cycles = s.missed_cycles;
  return s.published;
}

const char* BridgeCore::boot_detail() const noexcept {
  for (const auto& node : impl_->nodes) {
    const NodeBoot& boot = node->boot();
    if (!boot.operational() && !boot.configured()) return boot.detail().data();
  }
  return impl_->cyclic ? "all drives operational" : "all drives configured";
}

bool BridgeCore::operational() const noexcept { return impl_->cyclic; }

}  // namespace sprung
