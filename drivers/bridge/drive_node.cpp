#include "drivers/bridge/drive_node.h"

#include <cmath>

#include "drivers/canopen/objects.h"

namespace sprung {
namespace {

using canopen::NmtState;
using canopen::SdoStatus;
using cia402::PowerTarget;

constexpr std::int64_t kSdoTimeout_us =
    100'000;  // [design choice] an attempt; drives answer within milliseconds
constexpr std::int64_t kSupplyPeriod_us = 1'000'000;
constexpr std::int64_t kSupplyStagger_us = 20'000;  // a node: not all drives ask the bus in one cycle

const char* name(NmtState state) noexcept {
  switch (state) {
    case NmtState::kBootUp:
      return "it has restarted";
    case NmtState::kStopped:
      return "stopped";
    case NmtState::kOperational:
      return "operational";
    case NmtState::kPreOperational:
      return "pre-operational";
    case NmtState::kUnknown:
      break;
  }
  return "unknown state";
}

}  // namespace

DriveNode::DriveNode(const ActuatorConfig& actuator, double cycle_s, const WatchdogConfig& watchdogs)
    : actuator_(actuator),
      watchdogs_(watchdogs),
      profile_(make_profile(actuator, {cycle_s, watchdogs.heartbeat_s, watchdogs.heartbeat_consumer_s})),
      sdo_(actuator.node, kSdoTimeout_us),
      boot_(actuator_.name.c_str(), actuator.node,
            make_boot_script(actuator.identity, *profile_, actuator.node)),
      tracker_(actuator.speed_limit_rad_s) {}

void DriveNode::step(std::int64_t time_us, FrameBatch& out) noexcept {
  CanFrame frame;
  const bool send = boot_.operational() ? step_supply(time_us, frame) : boot_.step(time_us, sdo_, frame);
  if (send) out.push(actuator_.bus, frame);
}

bool DriveNode::step_supply(std::int64_t time_us, CanFrame& out) noexcept {
  if (sdo_.status() == SdoStatus::kDone) measured_supply_V_ = profile_->supply_V(sdo_.value());
  if (sdo_.status() != SdoStatus::kBusy) {
    sdo_.finish();  // a refusal or a time-out leaves the last value
    if (time_us < next_supply_us_) return false;
    next_supply_us_ = time_us + kSupplyPeriod_us;
    sdo_.read(profile_->supply_voltage_object());
  }
  return sdo_.step(time_us, out);
}

void DriveNode::receive(const CanFrame& frame, std::int64_t time_us) noexcept {
  const int node = actuator_.node;
  if (frame.id == canopen::sdo_server_id(node)) {
    sdo_.receive(frame);
  } else if (frame.id == canopen::heartbeat_id(node)) {
    receive_heartbeat(frame, time_us);
  } else if (frame.id == canopen::emcy_id(node)) {
    receive_emergency(frame);
  } else {
    receive_process_data(frame, time_us);
  }
}

void DriveNode::receive_heartbeat(const CanFrame& frame, std::int64_t time_us) noexcept {
  const NmtState state = canopen::heartbeat_state(frame);
  nmt_state_ = state;
  heartbeat_us_ = time_us;
  boot_.on_heartbeat(state, time_us);
}

void DriveNode::receive_emergency(const CanFrame& frame) noexcept {
  canopen::Emergency emergency;
  if (!canopen::decode_emergency(frame, emergency)) return;
  emergency_withdrawn_ = emergency.code == 0;
  if (emergency_withdrawn_) return;
  emergency_ = emergency;
  emergency_seen_ = false;
}

void DriveNode::receive_process_data(const CanFrame& frame, std::int64_t time_us) noexcept {
  if (profile_->decode_mode_display(frame, mode_display_)) {
    mode_display_known_ = true;
    return;
  }
  if (!boot_.started() || !profile_->decode_sample(frame, sample_)) return;
  power_state_ = cia402::decode_status(sample_.status_word);
  power_.observe(power_state_);
  if (!answered_) implausible_ = !tracker_.add(sample_.measured_position_rad, sync_us_) || implausible_;
  answered_ = true;
  sampled_ = true;
  if (boot_.operational()) return;
  boot_.confirm_operational();
  if (!boot_.operational()) return;
  nmt_state_ = NmtState::kOperational;
  heartbeat_us_ = time_us;
  next_supply_us_ = time_us + kSupplyStagger_us * actuator_.node;
  sdo_.finish();
  if (!mode_display_known_) mode_display_ = boot_.mode_display();
}

void DriveNode::begin_sampling(std::int64_t sync_us) noexcept {
  sync_us_ = sync_us;
  answered_ = false;
  implausible_ = false;
  if (emergency_withdrawn_ && emergency_seen_) emergency_ = {};
}

void DriveNode::end_sampling() noexcept { age_cycles_ = answered_ ? 0 : age_cycles_ + 1; }

bool DriveNode::powered() const noexcept {
  return power_state_ == PowerState::kOperationEnabled || power_state_ == PowerState::kQuickStopActive ||
         power_state_ == PowerState::kFaultReactionActive;
}

bool DriveNode::faulted() const noexcept {
  return emergency_.code != 0 || power_state_ == PowerState::kFault ||
         power_state_ == PowerState::kFaultReactionActive;
}

bool DriveNode::lost(std::int64_t time_us) const noexcept {
  const double silence_s = 1e-6 * static_cast<double>(time_us - heartbeat_us_);
  return !boot_.operational() || nmt_state_ != NmtState::kOperational ||
         silence_s > watchdogs_.drive_heartbeat_s;
}

void DriveNode::fill(ActuatorState& out) const noexcept {
  out.measured_position_rad = sampled_ ? sample_.measured_position_rad : kNaN;
  out.measured_link_position_rad = kNaN;
  out.measured_velocity_rad_s = kNaN;
  out.measured_current_A = sampled_ ? sample_.measured_current_A : kNaN;
  out.measured_supply_V = measured_supply_V_;
  out.fault_code = emergency_.code;
  out.age_cycles = age_cycles_;
  out.power_state = power_state_;
  const bool enabled = power_state_ == PowerState::kOperationEnabled;
  out.shown_mode = enabled ? profile_->shown_mode(mode_display_) : DriveMode::kDisabled;
  out.referenced = actuator_.referenced;
}

bool DriveNode::trouble(std::int64_t time_us, bool ignore_faults, Trouble& out) const noexcept {
  const char* drive = actuator_.name.c_str();
  if (faulted() && !ignore_faults) {
    out.cause = SafetyCause::kDriveFault;
    print(out.detail, "%s: drive fault 0x%04X (%s), state %s", drive, emergency_.code,
          canopen::emergency_text(emergency_.code), sprung::name(power_state_));
  } else if (power_.lost_power() && !ignore_faults) {
    out.cause = SafetyCause::kDriveFault;
    print(out.detail, "%s: lost its power by itself", drive);
  } else if (silent()) {
    out.cause = SafetyCause::kDriveSilent;
    print(out.detail, "%s: did not answer SYNC for %d cycles", drive, age_cycles_);
  } else if (lost(time_us)) {
    out.cause = SafetyCause::kDriveSilent;
    const bool left = nmt_state_ != NmtState::kOperational;
    print(out.detail, "%s: %s%s", drive, left ? "no longer operational: " : "no heartbeat",
          left ? name(nmt_state_) : "");
  } else if (implausible_) {
    out.cause = SafetyCause::kImplausible;
    print(out.detail, "%s: measured position jumped to %g rad", drive, sample_.measured_position_rad);
  } else {
    return false;
  }
  return true;
}

void DriveNode::reset_faults(bool reset) noexcept {
  power_.reset_faults(reset);
  const bool in_fault =
      power_state_ == PowerState::kFault || power_state_ == PowerState::kFaultReactionActive;
  if (reset && !in_fault) emergency_ = {};
}

void DriveNode::restart() noexcept {
  boot_.restart();
  power_ = PowerControl();
  tracker_.reset();
  mode_display_known_ = false;
  emergency_ = {};
}

PowerTarget DriveNode::target(SafetyLevel level, const ActuatorCommand& command) const noexcept {
  // Damping keeps what has torque and enables nothing.
  const PowerTarget kept =
      power_state_ == PowerState::kOperationEnabled ? PowerTarget::kEnabled : PowerTarget::kOff;
  switch (level) {
    case SafetyLevel::kOperational: {
      if (command.mode == DriveMode::kDisabled || !actuator_.referenced) return PowerTarget::kOff;
      return command.mode == DriveMode::kDamping ? kept : PowerTarget::kEnabled;
    }
    case SafetyLevel::kDamping:
      return kept;
    case SafetyLevel::kQuickStop:
      return PowerTarget::kQuickStop;
    case SafetyLevel::kDisabled:
      break;
  }
  return PowerTarget::kOff;
}

DriveSetpoint DriveNode::setpoint(SafetyLevel level, const ActuatorCommand& command) const noexcept {
  // Without a sample of this cycle nothing is known of the motion: an old velocity might drive, not damp.
  const double velocity_rad_s = answered_ ? tracker_.filtered_velocity_rad_s() : 0.0;
  DriveSetpoint setpoint{0.0, sample_.measured_position_rad, DriveMode::kTorque};
  if (level == SafetyLevel::kQuickStop)
    setpoint.mode = sent_mode_;  // no change of mode in a drive's own stop
  if (level == SafetyLevel::kOperational && command.mode == DriveMode::kPosition)
    setpoint.mode = DriveMode::kPosition;
  // Until the drive is enabled: no torque, and the position where it is, so that enabling moves nothing.
  if (power_state_ != PowerState::kOperationEnabled) return setpoint;
  if (level == SafetyLevel::kDamping) {
    setpoint.commanded_torque_Nm = -actuator_.safety_damping_Nm_s_rad * velocity_rad_s;
  } else if (level == SafetyLevel::kOperational) {
    if (command.mode == DriveMode::kDamping) {
      setpoint.commanded_torque_Nm = -command.commanded_damping_Nm_s_rad * velocity_rad_s;
    } else if (command.mode != DriveMode::kDisabled && std::isfinite(command.commanded_torque_Nm)) {
      setpoint.commanded_torque_Nm = command.commanded_torque_Nm;
    }
    if (command.mode == DriveMode::kPosition)
      setpoint.commanded_position_rad = command.commanded_position_rad;
  }
  return setpoint;
}

void DriveNode::emit(std::int64_t time_us, SafetyLevel level, const ActuatorCommand& command,
                     FrameBatch& out) noexcept {
  if (!boot_.operational()) return;
  const DriveSetpoint now = setpoint(level, command);
  sent_mode_ = now.mode;
  out.push(actuator_.bus, profile_->encode_setpoint(now));
  power_.set_target(target(level, command), time_us);
  std::uint16_t word = 0;
  if (power_.step(power_state_, time_us, word)) out.push(actuator_.bus, profile_->encode_control_word(word));
}

}  // namespace sprung
