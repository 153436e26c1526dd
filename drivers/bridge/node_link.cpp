#include "drivers/bridge/node_link.h"

#include <cstdarg>
#include <cstdio>
#include <cstring>

namespace sprung {
namespace {

using canopen::NmtState;

/// [design choice] an attempt; drives answer within milliseconds.
constexpr std::int64_t kSdoTimeout_us = 100'000;

const char* left_text(NmtState state) noexcept {
  return state == NmtState::kBootUp ? "it has restarted" : canopen::nmt_text(state);
}

}  // namespace

NodeLink::NodeLink(const NodeSetup& setup, const IdentityConfig& identity, const NodeProfile& profile,
                   bool has_power)
    : setup_(setup),
      has_power_(has_power),
      sdo_(setup.node, kSdoTimeout_us),
      boot_(setup_.name.c_str(), setup.node,
            make_boot_script(identity, profile, setup.node, has_power, setup.watched)),
      samples_(setup.watchdogs.silent_cycles),
      heartbeats_(setup.watchdogs),
      guard_(setup.watch == NodeWatch::kGuarding, to_us(setup.watchdogs.heartbeat_s)),
      second_device_(setup.watchdogs.heartbeat_s) {
  transmitted_bytes_.fill(-1);
  for (const PdoSetting& pdo : profile.pdos()) {
    if (!pdo.transmit || pdo.entries.empty()) continue;
    int bits = 0;
    for (const canopen::MapEntry& entry : pdo.entries) bits += entry.bits;
    transmitted_bytes_[pdo.number] = (bits + 7) / 8;
    const bool answers_sync = pdo.transmission_type != canopen::kTypeEvent;
    if (answers_sync && sample_pdo_ < 0) sample_pdo_ = pdo.number;
  }
  health_.bus = setup.bus;
  health_.node = setup.node;
  health_.actuator = setup.actuator;
}

bool NodeLink::step(std::int64_t time_us, FrameBatch& out) noexcept {
  heartbeats_.watch(time_us, in_operation());
  if (in_operation()) return false;
  CanFrame frame;
  const BootState before = boot_.state();
  if (boot_.step(time_us, sdo_, frame)) out.push(setup_.bus, frame);
  const BootState now = boot_.state();
  return now != before && (now == BootState::kProbe || now == BootState::kReset);
}

/// From NMT start on: before, the node has not been told its life time, and needs no watching.
void NodeLink::guard(std::int64_t time_us, std::int64_t cycle_us, FrameBatch& out) noexcept {
  if (!boot_.started()) return;
  guard_.set_guarded(setup_.watch == NodeWatch::kGuarding || boot_.guarded_instead());
  if (guard_.due(time_us, cycle_us)) out.push(setup_.bus, canopen::guard_request(setup_.node));
}

NodeEvents NodeLink::receive(const CanFrame& frame, std::int64_t time_us) noexcept {
  NodeEvents events;
  if (frame.id == canopen::sdo_server_id(setup_.node)) {
    sdo_.receive(frame);
  } else if (frame.id == canopen::heartbeat_id(setup_.node)) {
    receive_heartbeat(frame, time_us, events);
  } else if (frame.id == canopen::emcy_id(setup_.node)) {
    receive_emergency(frame);
  } else {
    receive_process_data(frame, time_us, events);
  }
  return events;
}

void NodeLink::receive_heartbeat(const CanFrame& frame, std::int64_t time_us, NodeEvents& events) noexcept {
  const canopen::GuardReply reply = canopen::decode_guard_reply(frame);
  const NmtState state = reply.state;
  if (state != NmtState::kUnknown && !guard_.answered(reply)) return;
  if (!heartbeats_.receive(state, time_us, in_operation())) return;
  if (state == NmtState::kBootUp && boot_.configuring()) {
    ++health_.boot_ups;
    events.maybe_off = true;
  }
  if (in_operation()) second_device_.said(state, samples_.owed());
  boot_.on_heartbeat(state, time_us);
}

void NodeLink::receive_emergency(const CanFrame& frame) noexcept {
  canopen::Emergency emergency;
  if (canopen::decode_emergency(frame, emergency)) emergencies_.receive(emergency);
}

void NodeLink::receive_process_data(const CanFrame& frame, std::int64_t time_us,
                                    NodeEvents& events) noexcept {
  const auto pdo = static_cast<int>((frame.id - canopen::kTpdoBase) / 0x100U);
  const bool transmits = frame.id >= canopen::kTpdoBase && pdo < canopen::kPdoCount &&
                         frame.id == canopen::tpdo_id(pdo, setup_.node);
  events.expected = transmits;
  if (!boot_.started()) return;  // by the node's defaults until it is configured
  const int bytes = transmits ? transmitted_bytes_[pdo] : -1;
  events.expected = bytes >= 0;
  if (bytes < 0) return;
  if (frame.length != bytes || frame.remote) {
    ++health_.short_frames;
  } else if (pdo == sample_pdo_) {
    receive_sample(frame, time_us, events);
  } else {
    events.other = true;
  }
}

void NodeLink::receive_sample(const CanFrame& frame, std::int64_t time_us, NodeEvents& events) noexcept {
  events.operational = confirm_operational(time_us);
  const Answer answer = samples_.receive(frame, time_us);
  events.sample = answer == Answer::kSample;
  if (answer == Answer::kConflict) second_device_.conflict();
}

bool NodeLink::confirm_operational(std::int64_t time_us) noexcept {
  if (in_operation()) return false;
  boot_.confirm_operational();
  if (!in_operation()) return false;
  heartbeats_.begin_operation(time_us);
  samples_.begin_operation();
  sdo_.finish();
  return true;
}

void NodeLink::begin_sampling(std::int64_t sync_us) noexcept {
  second_device_.begin_cycle();
  samples_.begin(sync_us, in_operation());
  emergencies_.begin_cycle();
}

void NodeLink::end_sampling(bool accepted) noexcept {
  samples_.end(accepted, in_operation());
  second_device_.judge(samples_.answered(), samples_.sync_us(), heartbeats_.rebooted());
}

bool NodeLink::lost(std::int64_t time_us) const noexcept {
  return !in_operation() || !heartbeats_.operational() || heartbeats_.missing(time_us);
}

bool NodeLink::gone() const noexcept { return !heartbeats_.operational() && samples_.age_cycles() > 0; }

const char* NodeLink::silence_text() const noexcept {
  if (!guard_.guarded()) return "no heartbeat";
  return guard_.toggle_stands() ? "the toggle bit of its answers to node guarding stands"
                                : "no answer to node guarding";
}

bool NodeLink::fault(std::int64_t time_us, bool ignore_faults, Fault& out) const noexcept {
  const char* who = setup_.name.c_str();
  const int code = emergencies_.emergency().code;
  out.cause = SafetyCause::kDriveSilent;
  if (duplicate()) {
    out.cause = SafetyCause::kDuplicateNode;
    print(out.detail, "%s: two devices answer as node %d; switch one off or give it another id", who,
          setup_.node);
  } else if (emergencies_.stands() && !ignore_faults) {
    out.cause = SafetyCause::kDriveFault;
    print(out.detail, "%s: fault 0x%04X (%s)", who, code,
          canopen::emergency_text(emergencies_.emergency().code));
  } else if (gone()) {
    print(out.detail, "%s: no longer operational: %s", who, left_text(heartbeats_.word()));
  } else if (silent()) {
    const bool late = !samples_.too_old();
    print(out.detail, "%s: did not answer SYNC%s for %d cycles", who, late ? " in time" : "",
          late ? samples_.untimely_cycles() : samples_.age_cycles());
  } else if (heartbeats_.missing(time_us)) {
    print(out.detail, "%s: %s", who, silence_text());
  } else {
    return false;
  }
  return true;
}

void NodeLink::restart() noexcept {
  boot_.restart();
  sdo_.finish();
  emergencies_.forget();
  second_device_.restart();
  heartbeats_.restart();
  guard_.restart();
  samples_.restart();
  bus_loss_ = "";
}

bool NodeLink::needs_restart(std::int64_t time_us) const noexcept {
  const bool by_fault = has_power_ ? emergencies_.communication_fault() : emergencies_.stands();
  return by_fault || lost(time_us) || silent() || duplicate() || *bus_loss_ != 0;
}

void NodeLink::set_recovery_text(const char* note, const char* format, ...) noexcept {
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(health_.recovery.data(), health_.recovery.size(), format, arguments);
  va_end(arguments);
  if (*note == 0) return;
  const std::size_t used = std::strlen(health_.recovery.data());
  std::snprintf(health_.recovery.data() + used, health_.recovery.size() - used, "; %s", note);
}

NodeHealth NodeLink::health() const noexcept {
  NodeHealth health = health_;
  samples_.show(health);
  heartbeats_.show(health);
  emergencies_.show(health);
  health.heartbeat_losses += guard_.toggle_errors();
  health.sdo_failures += boot_.sdo_failures();
  health.operational = in_operation() && heartbeats_.operational();
  return health;
}

}  // namespace sprung
