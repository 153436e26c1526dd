#include "drivers/bridge/bridge_shell.h"

#include <algorithm>
#include <cmath>

#include "drivers/bridge/traced_frame_shell.h"
#include "lcmtypes/channels.h"
#include "runtime/log.h"
#include "runtime/session_clock.h"
#include "runtime/utc_text.h"

namespace sprung {

namespace {

constexpr std::int64_t kInterval_us = 100'000;  // of what is also published on change
constexpr std::int64_t kAuxiliary_us = 1'000'000;
/// CAN_TRACE's own limit: four buses of 15 frames a cycle fit four times.
constexpr std::size_t kTraceCapacity = 256;

bool differs(const SafetyState& a, const SafetyState& b) {
  return a.level != b.level || a.cause != b.cause || a.latched != b.latched;
}

/// So that a log of lock-step has the cycle itself. An orderly end waits for nobody.
bool missed_more(const SafetyState& a, const SafetyState& b) {
  return a.missed_cycles != b.missed_cycles && a.cause != SafetyCause::kShutdown;
}

/// In what somebody waits for; counters alone wait for the next tenth of a second.
bool differs(const BusState& a, const BusState& b) {
  const auto same_bus = [](const BusHealth& x, const BusHealth& y) { return x.condition == y.condition; };
  const auto same_node = [](const NodeHealth& x, const NodeHealth& y) {
    return x.operational == y.operational;
  };
  return a.recovering != b.recovering ||
         !std::equal(a.buses.begin(), a.buses.end(), b.buses.begin(), b.buses.end(), same_bus) ||
         !std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(), b.nodes.end(), same_node);
}

}  // namespace

BridgeShell::BridgeShell(Process& process, BridgeCore& core)
    : process_(process),
      core_(core),
      last_state_(process.robot().actuators.size()),
      commands_(DriveCommand(process.robot().actuators.size())),
      drive_states_(process.node().publisher<DriveState>(channels::kDriveState)),
      safety_states_(process.node().publisher<SafetyState>(channels::kSafetyState)),
      bus_states_(process.node().publisher<BusState>(channels::kBusState)),
      auxiliary_states_(process.node().publisher<AuxiliaryState>(channels::kAuxiliaryState)),
      replies_(process.node().publisher<OperatorReply>(channels::kOperatorReply)) {
  process.node().subscribe(channels::kDriveCommand, CountLimits::exactly(process.robot().actuators.size()),
                           commands_);
  process.node().subscribe(channels::kOperatorCommand, CountLimits::none(), operators_);
  trace_.frames.reserve(kTraceCapacity);
  if (!process.lockstep()) {
    restore_references();
  }
}

void BridgeShell::restore_references() {
  const RobotConfig& robot = process_.robot();
  const std::string path = reference_file(robot.name, process_.options().simulation);
  if (path.empty()) {
    return;
  }
  try {
    references_.emplace(path, robot);
  } catch (const std::exception& error) {
    log_error(error.what());
    return;
  }
  for (std::size_t i = 0; i < robot.actuators.size(); ++i) {
    if (const std::optional<Reference> reference = references_->good_for(i)) {
      core_.restore_reference(static_cast<int>(i), *reference);
      log_info(robot.actuators[i].name + ": reference restored from " + path);
      if (const long days = references_->doubtful_days(i, utc_text(utc_us())); days > 0)
        log_warn(robot.actuators[i].name + ": its zero was found " + std::to_string(days) +
                 " days ago, more than reference's max_age_days; sprung home");
    }
  }
}

/// Homing happens without power, so a file may take its time here.
void BridgeShell::store_references() {
  stored_homings_ = core_.homings();
  if (!references_) {
    return;
  }
  for (std::size_t i = 0; i < last_state_.actuators.size(); ++i) {
    const Reference& reference = core_.reference(static_cast<int>(i));
    const std::optional<Reference> stored = references_->good_for(i);
    const bool changed = !stored || stored->offset_rad != reference.offset_rad;
    if (reference.known && reference.source != ReferenceSource::kConfigured && changed) {
      references_->record(i, reference, core_.encoder_counts(static_cast<int>(i)), utc_text(utc_us()) + "Z");
    }
  }
  try {
    references_->save();
  } catch (const std::exception& error) {
    log_error(error.what());
  }
}

void BridgeShell::publish_cycle(const DriveState& state) {
  last_state_ = state;
  drive_states_.publish(state);
  publish_safety_if_due(state.stamp.utime_us);
  publish_buses_if_due(state.stamp.utime_us);
  publish_auxiliary_if_due(state.stamp.utime_us);
  publish_replies();
  publish_trace(state.stamp);
  process_.status().stamp = state.stamp;
}

void BridgeShell::publish_trace(const Stamp& stamp) {
  trace_.utime = stamp.utime_us;
  trace_.seq = stamp.seq;
  trace_.n = static_cast<std::int32_t>(trace_.frames.size());
  process_.node().publish_message(channels::kCanTrace, trace_);
  trace_.frames.clear();
  if (trace_lost_ > reported_lost_) {
    process_.status().detail = "CAN_TRACE is full: " + std::to_string(trace_lost_) + " frames not in it";
    reported_lost_ = trace_lost_;
  }
}

void BridgeShell::follow_start() {
  const bool waiting = process_.status().state == ProcessState::kReady;
  if (waiting && core_.safety().level == SafetyLevel::kOperational) {
    process_.set_state(ProcessState::kRunning);
    process_.status().detail.clear();
    tell_boot();
  }
}

void BridgeShell::tell_boot() {
  told_boot_ = true;
  for (const std::string& line : core_.boot_report()) log_info(line);
}

void BridgeShell::report_end() {
  if (!told_boot_) tell_boot();
  for (const std::string& line : core_.restore_report()) log_info(line);
}

void BridgeShell::repeat_drive_state() { drive_states_.publish(last_state_); }

void BridgeShell::publish_boot() {
  publish_safety_if_due(process_.node().utime_us());
  publish_buses_if_due(process_.node().utime_us());
  publish_replies();
  process_.status().detail = core_.boot_detail();
  if (!trace_.frames.empty()) {
    publish_trace(Stamp{trace_.frames.front().utime, -1});
  }
}

void BridgeShell::publish_safety_if_due(std::int64_t now_us) {
  const SafetyState& safety = core_.safety();
  const bool missed = process_.lockstep() && missed_more(safety, last_safety_);
  if (missed || differs(safety, last_safety_) || now_us >= next_safety_us_ ||
      next_safety_us_ - now_us > kInterval_us) {
    safety_states_.publish(safety);
    last_safety_ = safety;
    next_safety_us_ = now_us + kInterval_us;
  }
}

void BridgeShell::publish_buses_if_due(std::int64_t now_us) {
  const BusState& buses = core_.bus_state();
  const bool due = now_us >= next_buses_us_ || next_buses_us_ - now_us > kInterval_us;
  if (!due && !differs(buses, last_buses_)) {
    return;
  }
  bus_states_.publish(buses);
  last_buses_ = buses;
  next_buses_us_ = now_us + kInterval_us;
}

void BridgeShell::publish_auxiliary_if_due(std::int64_t now_us) {
  if (!process_.robot().has_auxiliary_readings() || now_us < next_auxiliary_us_) return;
  next_auxiliary_us_ = now_us + kAuxiliary_us;
  const AuxiliaryState& state = core_.auxiliary_state();
  auxiliary_states_.publish(state);
  const double least = process_.robot().battery.min_charge_share;
  if (told_low_battery_ || !(state.battery_charge_share < least)) return;
  told_low_battery_ = true;
  log_warn("battery at " + std::to_string(std::lround(100.0 * state.battery_charge_share)) +
           " %, robot.yaml wants " + std::to_string(std::lround(100.0 * least)) +
           " % at least: let the robot sit, then charge");
}

void BridgeShell::publish_replies() {
  OperatorReply reply;
  while (core_.next_reply(reply)) {
    replies_.publish(reply);
  }
  if (core_.homings() != stored_homings_) {
    store_references();
  }
}

void BridgeShell::count_traffic(int bus, const CanBusCounters& counters) {
  core_.set_traffic(bus, {counters.send_failed, counters.no_buffers, counters.dropped, counters.malformed});
}

void BridgeShell::trace(const FrameBatch& frames, bool sent, std::int64_t time_us) {
  for (const BusFrame& frame : frames) {
    trace(frame.bus, frame.frame, sent, time_us);
  }
}

void BridgeShell::trace(int bus, const CanFrame& frame, bool sent, std::int64_t time_us) {
  if (trace_.frames.size() == kTraceCapacity) {
    ++trace_lost_;
    return;
  }
  trace_.frames.push_back(traced_frame(bus, frame, sent, time_us));
}

void BridgeShell::serve_operators(std::int64_t time_us) {
  while (const std::optional<OperatorCommand> command = operators_.pop()) {
    const OperatorKind kind = command->kind;
    if (kind == OperatorKind::kEstop || kind == OperatorKind::kClear || kind == OperatorKind::kHome) {
      replies_.publish(core_.operator_command(*command, time_us));
      publish_safety_if_due(time_us);
    }
  }
}

bool BridgeShell::take_command(DriveCommand& out) {
  // A controller that outlived an earlier bridge may still send that one's cycles.
  if (!commands_.newest_at_or_before(last_state_.stamp.seq, out) || out.stamp.seq <= last_command_seq_) {
    return false;
  }
  last_command_seq_ = out.stamp.seq;
  return true;
}

}  // namespace sprung
