#include "drivers/bridge/bridge_impl.h"

#include <algorithm>
#include <stdexcept>

namespace sprung {
namespace {

constexpr std::int64_t kRecovery_us = 300'000;  // [design choice] for fault resets after start and clear
constexpr double kSlow_rad_s = 0.1;             // [design choice] nearly at rest

}  // namespace

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
      return;  // one at a time: the detail has room for one
    }
  }
}

/// Drives often come up with a fault (facts canopen 2.5), so cyclic operation begins with resetting them.
void BridgeCore::Impl::begin_cycle(std::int64_t time_us) noexcept {
  if (!cyclic) {
    recover(time_us);
    bus_trouble_new = bus_trouble_new && any_bus_lost();  // what booting has got over is no trouble
  }
  cyclic = true;
  ++cycle;
}

void BridgeCore::Impl::recover(std::int64_t time_us) noexcept {
  recovering = true;
  recover_until_us = time_us + kRecovery_us;
}

bool BridgeCore::Impl::any_bus_lost() const noexcept {
  return std::find(bus_lost.begin(), bus_lost.end(), true) != bus_lost.end();
}

/// Before this cycle's command is due, that of the cycle before counts as new.
double BridgeCore::Impl::command_age_s(std::int64_t time_us, bool command_due) const noexcept {
  if (!gate.any()) return 0.0;
  const std::int64_t age_us = command_due ? time_us - good_sync_us : sync_us - good_sync_us - cycle_us;
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
  inputs.command_age_s = command_age_s(time_us, command_due);
  inputs.command_expired = command_due && gate.any() && time_us > gate.last().valid_until_utime_us;
  inputs.command_refused = gate.last_was_refused();
  inputs.refusal = &gate.detail();
  inputs.drive = !safety.latched() && find_trouble(time_us, drive_trouble) ? &drive_trouble : nullptr;
  inputs.bus = bus_trouble_new ? &bus_trouble : nullptr;
  inputs.overruns_in_row = overruns_in_row;
  inputs.slow =
      all_nodes([](const DriveNode& n) { return std::abs(n.filtered_velocity_rad_s()) < kSlow_rad_s; });
  safety.update(inputs);
  for (auto& node : nodes) node->faults_seen();
  bus_trouble_new = false;
  if (safety.latched()) gate.disarm();
}

const char* BridgeCore::Impl::why_not_clear(std::int64_t time_us) noexcept {
  if (shutting_down) return "the bridge is shutting down";
  if (any_bus_lost()) return "a bus is lost; see SAFETY_STATE";
  bool booting = false;
  for (auto& node : nodes) {
    if (!node->lost(time_us)) continue;
    booting = true;
    if (node->boot().operational() || node->boot().refused()) node->restart();
  }
  if (booting) return "a drive is not operational; it is being configured again, then clear once more";
  for (auto& node : nodes) {
    if (node->silent()) return "a drive does not answer";
    if (node->powered()) return "drives are still stopping";
  }
  const bool by_command =
      safety.cause() == SafetyCause::kCommandStale || safety.cause() == SafetyCause::kCommandRefused;
  if (by_command && command_age_s(time_us, false) > watchdogs.command_hold_s)
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

}  // namespace sprung
