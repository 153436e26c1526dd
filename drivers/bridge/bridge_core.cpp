#include "drivers/bridge/bridge_core.h"

#include "drivers/bridge/bridge_impl.h"
#include "drivers/can/can_errors.h"

namespace sprung {
namespace {

// [design choice] then the process may end although a drive still shows power
constexpr std::int64_t kShutdownLimit_us = 2'000'000;

}  // namespace

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
