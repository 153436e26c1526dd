#include "drivers/bridge/bridge_core.h"

#include "drivers/bridge/boot_report.h"
#include "drivers/bridge/bridge_impl.h"

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
  const int first = out.size();
  s.now_us = time_us;
  s.buses.begin_cycle(time_us);
  s.step_boot(time_us);
  if (s.shutting_down && s.at_rest()) s.begin_restore();
  for (BusNode* node : s.nodes) node->step(time_us, out);
  if (CanFrame question; s.battery.step(time_us, question)) out.push(s.battery.bus(), question);
  s.push_heartbeats(time_us, out);
  s.push_guarding(time_us, out);
  s.sync_us = time_us;
  for (BusNode* node : s.nodes) node->link().begin_sampling(time_us);
  s.push_on_every_bus(canopen::sync_frame(), out);
  s.count_sent(out, first);
}

void BridgeCore::receive(int bus, const CanFrame& frame, std::int64_t time_us) noexcept {
  Impl& s = *impl_;
  if (bus < 0 || static_cast<std::size_t>(bus) >= s.by_bus_and_node.size()) return;
  if (frame.error) {
    s.buses.error_frame(bus, frame);
    return;
  }
  const int id = static_cast<int>(frame.id & 0x7F);
  BusNode* node = s.by_bus_and_node[bus][id];
  const bool of_battery = s.battery.bus() == bus && s.battery.node() == id;
  if (of_battery) s.battery.receive(frame);
  const bool expected = of_battery || (node != nullptr && node->receive(frame, time_us));
  s.buses.received(bus, frame, expected);
  s.masters.receive(bus, frame, node != nullptr);
}

bool BridgeCore::all_answered() const noexcept {
  return impl_->all_links(
      [](const NodeLink& link) { return !link.boot().started() || link.samples().caught_up(); });
}

bool BridgeCore::end_sampling(std::int64_t time_us, DriveState& out) noexcept {
  Impl& s = *impl_;
  s.now_us = time_us;
  s.judge_samples();
  s.step_requests(time_us);
  const bool all_sampled = s.all_links(
      [](const NodeLink& link) { return link.boot().operational() && link.samples().answered(); });
  // A clear before the first cycle is answered first.
  if (!s.cyclic && (!all_sampled || s.recovery->running())) return false;
  s.begin_cycle(time_us);
  s.update_safety(time_us, false);
  s.state.stamp = {s.sync_us, s.cycle};
  s.state.safety = s.safety.level();
  for (std::size_t i = 0; i < s.drives.size(); ++i) s.drives[i]->fill(s.state.actuators[i]);
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
  const int first = out.size();
  s.update_safety(time_us, true);
  s.emit(time_us, out);
  s.count_sent(out, first);
}

OperatorReply BridgeCore::operator_command(const OperatorCommand& command, std::int64_t time_us) noexcept {
  Impl& s = *impl_;
  s.now_us = time_us;
  switch (command.kind) {
    case OperatorKind::kEstop:
      s.emergency_stop(time_us, nullptr);
      return s.reply(command, nullptr);
    case OperatorKind::kClear:
      return s.clear(command, time_us);
    case OperatorKind::kHome:
      return s.home(command, time_us);
    default:
      return s.reply(command, "not the bridge's request");
  }
}

bool BridgeCore::next_reply(OperatorReply& out) noexcept {
  for (LongRequest* request : {&impl_->last_clear, &impl_->last_home}) {
    if (!request->answer_due) continue;
    request->answer_due = false;
    out = request->reply;
    return true;
  }
  return false;
}

void BridgeCore::send_failed(int bus, SendFailure failure, std::int64_t time_us) noexcept {
  impl_->now_us = time_us;
  impl_->buses.send_failed(bus, failure);
}

void BridgeCore::set_traffic(int bus, const BusTraffic& traffic) noexcept {
  impl_->buses.set_traffic(bus, traffic);
}

void BridgeCore::restore_reference(int actuator, const Reference& reference) noexcept {
  impl_->drives[actuator]->set_reference(reference);
}

const Reference& BridgeCore::reference(int actuator) const noexcept {
  return impl_->drives[actuator]->reference();
}

std::int64_t BridgeCore::encoder_counts(int actuator) const noexcept {
  return impl_->drives[actuator]->encoder_counts();
}

std::int64_t BridgeCore::homings() const noexcept { return impl_->homings; }

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
  s.recovery->abort("the bridge is shutting down");
}

bool BridgeCore::shut_down() const noexcept {
  const Impl& s = *impl_;
  if (!s.shutting_down) return false;
  if (!s.cyclic || s.now_us - s.shutdown_us > kShutdownLimit_us) return true;
  return s.at_rest() && s.all_drives([](const DriveNode& n) { return n.restored(); });
}

std::vector<std::string> BridgeCore::boot_report() const {
  std::vector<std::string> lines;
  for (const BusNode* node : impl_->nodes) report_boot(node->link(), lines);
  return lines;
}

std::vector<std::string> BridgeCore::restore_report() const {
  std::vector<std::string> lines;
  for (const auto& drive : impl_->drives) report_restore(*drive, lines);
  return lines;
}

const SafetyState& BridgeCore::safety() const noexcept {
  Impl& s = *impl_;
  s.published = s.safety.state();
  s.published.stamp = {s.now_us, s.cycle};
  s.published.commands_refused = s.gate.refused();
  s.published.overruns = s.overruns;
  s.published.missed_cycles = s.missed_cycles;
  for (const auto& drive : s.drives) {
    if (drive->reference().known || s.published.level != SafetyLevel::kOperational) continue;
    print(s.published.detail, "%s is not referenced and gets no torque: sprung home", drive->name().c_str());
    break;
  }
  if (s.published.level != SafetyLevel::kOperational) s.show_stops(s.published.detail);
  return s.published;
}

const BusState& BridgeCore::bus_state() const noexcept {
  Impl& s = *impl_;
  s.bus_state.stamp = {s.now_us, s.cycle};
  s.bus_state.recovering = s.recovery->kind() == Recovery::Kind::kClear ||
                           s.recovery->kind() == Recovery::Kind::kBoot;
  for (std::size_t i = 0; i < s.bus_state.buses.size(); ++i) s.bus_state.buses[i] = s.buses.health(i);
  for (std::size_t i = 0; i < s.nodes.size(); ++i) s.bus_state.nodes[i] = s.nodes[i]->link().health();
  for (std::size_t i = 0; i < s.drives.size(); ++i) {
    s.drives[i]->show(s.bus_state.nodes[i]);
    s.setpoints.show(i, s.bus_state.nodes[i]);
  }
  return s.bus_state;
}

const AuxiliaryState& BridgeCore::auxiliary_state() const noexcept {
  Impl& s = *impl_;
  s.auxiliary.stamp = {s.now_us, s.cycle};
  for (std::size_t i = 0; i < s.drives.size(); ++i)
    s.auxiliary.measured_temperature_degC[i] = s.drives[i]->temperature_degC();
  s.battery.show(s.auxiliary);
  return s.auxiliary;
}

const char* BridgeCore::boot_detail() const noexcept {
  Impl& s = *impl_;
  for (const BusNode* node : s.nodes) {
    const NodeBoot& boot = node->link().boot();
    if (!boot.operational() && !boot.configured()) return boot.detail().data();
  }
  if (s.cyclic) return "all drives operational";
  for (const BusNode* node : s.nodes) {
    if (!node->link().boot().operational() || node->link().samples().answered()) continue;
    print(s.boot_text, "%s: did not answer SYNC", node->name().c_str());
    return s.boot_text.data();
  }
  return "all drives configured";
}

bool BridgeCore::operational() const noexcept { return impl_->cyclic; }

}  // namespace sprung
