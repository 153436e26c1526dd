#include "drivers/bridge/drive_node.h"

#include <cmath>

#include "drivers/canopen/objects.h"
#include "signals/angles.h"

namespace sprung {
namespace {

using canopen::SdoStatus;
using cia402::PowerTarget;

constexpr std::int64_t kSupplyPeriod_us = 1'000'000;
constexpr std::int64_t kSupplyStagger_us = 20'000;  // a node: not all drives ask the bus in one cycle
// [design choice] a TPDO2 that was lost is asked for after this; drives switch within milliseconds
constexpr std::int64_t kModeRead_us = 50'000;
constexpr std::int64_t kModeLimit_us = 1'000'000;
// [design choice] more than a loaded gear twists, less than half a motor turn at 50:1 (0.063 rad) and 100:1
// tells
constexpr double kApart_rad = 0.05;
constexpr int kApartCycles = 10;

double quantum_rad(const ActuatorConfig& actuator) noexcept {
  return 2.0 * kPi / (actuator.encoder_counts_per_turn * actuator.gear_ratio);
}

std::unique_ptr<DriveProfile> make_raw_profile(ActuatorConfig actuator, double cycle_s,
                                               const WatchdogConfig& watchdogs) {
  actuator.offset_rad = 0.0;
  return make_profile(actuator, {cycle_s, watchdogs.heartbeat_s, watchdogs.heartbeat_consumer_s});
}

}  // namespace

DriveNode::DriveNode(const ActuatorConfig& actuator, int index, double cycle_s,
                     const WatchdogConfig& watchdogs)
    : DriveNode(actuator, index, watchdogs, make_raw_profile(actuator, cycle_s, watchdogs)) {}

DriveNode::DriveNode(const ActuatorConfig& actuator, int index, const WatchdogConfig& watchdogs,
                     std::unique_ptr<DriveProfile> profile)
    : NodeLink({actuator.name, actuator.bus, actuator.node, index, watchdogs}, actuator.identity, *profile,
               true),
      actuator_(actuator),
      profile_(std::move(profile)),
      tracker_(actuator.speed_limit_rad_s, quantum_rad(actuator)),
      reference_{actuator.offset_rad, actuator.referenced, ReferenceSource::kConfigured} {}

bool DriveNode::step_background(std::int64_t time_us, canopen::SdoClient& sdo, CanFrame& out) noexcept {
  if (sdo.status() != SdoStatus::kBusy) {
    take_reading(sdo);
    reading_ = next_reading(time_us);
    if (reading_ == Reading::kNothing) return false;
    sdo.read(object_of(reading_));
  }
  return sdo.step(time_us, out);
}

/// A refusal or a time-out leaves the last value.
void DriveNode::take_reading(canopen::SdoClient& sdo) noexcept {
  const bool good = sdo.status() == SdoStatus::kDone;
  if (!good && sdo.status() != SdoStatus::kIdle) count_sdo_failure();
  if (reading_ == Reading::kSupply && good) measured_supply_V_ = profile_->supply_V(sdo.value());
  if (reading_ == Reading::kMode && good) mode_display_ = static_cast<std::int8_t>(sdo.value() & 0xFF);
  if (reading_ == Reading::kIndex) {
    // Until an index pulse has been passed the count is 0 [U].
    index_answer_ = good && sdo.value() != 0 ? IndexAnswer::kKnown : IndexAnswer::kFailed;
    index_position_rad_ =
        actuator_.direction * static_cast<std::int32_t>(sdo.value()) * quantum_rad(actuator_);
  }
  reading_ = Reading::kNothing;
  sdo.finish();
}

DriveNode::Reading DriveNode::next_reading(std::int64_t time_us) noexcept {
  if (index_answer_ == IndexAnswer::kWaiting) return Reading::kIndex;
  if (unconfirmed_us_ > kModeRead_us && time_us >= next_mode_read_us_) {
    next_mode_read_us_ = time_us + kModeRead_us;
    return Reading::kMode;
  }
  if (time_us < next_supply_us_ || profile_->supply_voltage_object().index == 0) return Reading::kNothing;
  next_supply_us_ = time_us + kSupplyPeriod_us;
  return Reading::kSupply;
}

canopen::ObjectId DriveNode::object_of(Reading reading) const noexcept {
  if (reading == Reading::kMode) return {canopen::kModeDisplay, 0};
  return reading == Reading::kIndex ? profile_->index_counter_object() : profile_->supply_voltage_object();
}

void DriveNode::take_other(const CanFrame& frame) noexcept {
  if (profile_->decode_mode_display(frame, mode_display_)) mode_display_known_ = true;
}

void DriveNode::take_sample(const CanFrame& frame, std::int64_t time_us) noexcept {
  DriveSample sample;
  if (!profile_->decode_sample(frame, sample)) return;
  power_state_ = cia402::decode_status(sample.status_word);
  power_.observe(power_state_);
  sample_ = sample;
  received_us_ = time_us;
}

bool DriveNode::accept_sample() noexcept {
  const Motion motion =
      tracker_.add(sample_.measured_position_rad, {sample_sync_us(), earliest_sync_us(), received_us_});
  implausible_ = motion != Motion::kGood;
  if (implausible_) count_implausible();
  // Also an absolute encoder's: what it shows from now on is not the place that the reference was found for.
  if (motion == Motion::kJumped) lose_reference("reference lost: encoder jumped");
  sampled_ = true;
  return true;
}

void DriveNode::on_operational(std::int64_t time_us) noexcept {
  reading_ = Reading::kNothing;
  next_supply_us_ = time_us + kSupplyStagger_us * setup().node;
  if (!mode_display_known_) mode_display_ = boot().mode_display();
  confirmed_at_us_ = time_us;
  unconfirmed_us_ = 0;
}

/// A count that power keeps stays good; any other begins at zero when the drive does.
void DriveNode::doubt_reference() noexcept {
  if (!actuator_.reference.absolute_encoder) lose_reference("reference lost: it may have restarted");
}

void DriveNode::lose_reference(const char* why) noexcept {
  if (reference_.known) reference_loss_ = why;
  reference_.known = false;
}

std::int64_t DriveNode::encoder_counts() const noexcept {
  return std::llround(actuator_.direction * tracker_.position_rad() / quantum_rad(actuator_));
}

void DriveNode::set_reference(const Reference& reference) noexcept {
  reference_ = reference;
  reference_loss_ = "";
  apart_ = false;
  cycles_apart_ = 0;
}

void DriveNode::set_link_position(double measured_link_position_rad) noexcept {
  measured_link_position_rad_ = measured_link_position_rad;
  const bool comparable =
      reference_.known && answered() && !implausible_ && std::isfinite(measured_link_position_rad);
  if (!comparable) return;
  const double difference_rad =
      std::remainder(measured_link_position_rad - measured_position_rad(), 2.0 * kPi);
  const bool apart = std::abs(difference_rad) > kApart_rad;
  cycles_apart_ = apart ? cycles_apart_ + 1 : 0;
  if (cycles_apart_ < kApartCycles) return;
  apart_ = true;
  lose_reference("reference lost: encoders disagree");
}

bool DriveNode::powered() const noexcept {
  return power_state_ == PowerState::kOperationEnabled || power_state_ == PowerState::kQuickStopActive ||
         power_state_ == PowerState::kFaultReactionActive;
}

bool DriveNode::faulted() const noexcept {
  return NodeLink::faulted() || power_state_ == PowerState::kFault ||
         power_state_ == PowerState::kFaultReactionActive;
}

bool DriveNode::mode_confirmed() const noexcept {
  return power_state_ != PowerState::kOperationEnabled || profile_->shown_mode(mode_display_) == sent_mode_;
}

NodeHealth DriveNode::health() const noexcept {
  NodeHealth health = NodeLink::health();
  health.reference_offset_rad = reference_.known ? reference_.offset_rad : kNaN;
  health.reference_source = reference_.source;
  return health;
}

void DriveNode::fill(ActuatorState& out) const noexcept {
  out.measured_position_rad = sampled_ ? measured_position_rad() : kNaN;
  out.measured_link_position_rad = measured_link_position_rad_;
  out.measured_velocity_rad_s = kNaN;
  out.measured_current_A = sampled_ ? sample_.measured_current_A : kNaN;
  out.measured_supply_V = measured_supply_V_;
  out.fault_code = emergency().code;
  out.age_cycles = age_cycles();
  out.power_state = power_state_;
  const bool enabled = power_state_ == PowerState::kOperationEnabled;
  out.shown_mode = enabled ? profile_->shown_mode(mode_display_) : DriveMode::kDisabled;
  out.referenced = reference_.known;
}

bool DriveNode::trouble(std::int64_t time_us, bool ignore_faults, Trouble& out) const noexcept {
  const char* drive = actuator_.name.c_str();
  if (!duplicate() && faulted() && !ignore_faults) {
    out.cause = SafetyCause::kDriveFault;
    print(out.detail, "%s: drive fault 0x%04X (%s), state %s", drive, emergency().code,
          canopen::emergency_text(emergency().code), sprung::name(power_state_));
  } else if (!duplicate() && power_.lost_power() && !ignore_faults && !lost(time_us)) {
    out.cause = SafetyCause::kDriveFault;
    print(out.detail, "%s: lost its power by itself", drive);
  } else {
    return NodeLink::trouble(time_us, ignore_faults, out) || own_trouble(out);
  }
  return true;
}

bool DriveNode::own_trouble(Trouble& out) const noexcept {
  const char* drive = actuator_.name.c_str();
  if (implausible_) {
    out.cause = SafetyCause::kImplausible;
    print(out.detail, "%s: measured position jumped to %g rad", drive,
          sample_.measured_position_rad + reference_.offset_rad);
  } else if (apart_ && powered()) {
    out.cause = SafetyCause::kImplausible;
    print(out.detail, "%s: motor encoder says %g rad, link encoder %g rad; reference lost: sprung home",
          drive, measured_position_rad(), measured_link_position_rad_);
  } else if (unconfirmed_us_ > kModeLimit_us) {
    out.cause = SafetyCause::kDriveFault;
    print(out.detail, "%s: shows mode %d, a second after it was told to switch to %s", drive, mode_display_,
          sprung::name(sent_mode_));
  } else {
    return false;
  }
  return true;
}

void DriveNode::reset_faults(bool reset) noexcept {
  power_.reset_faults(reset);
  const bool in_fault =
      power_state_ == PowerState::kFault || power_state_ == PowerState::kFaultReactionActive;
  if (!in_fault) NodeLink::reset_faults(reset);
}

void DriveNode::restart() noexcept {
  // One that was silent may have lost its supply and with it an incremental encoder's count.
  if (silent() && boot().operational()) doubt_reference();
  NodeLink::restart();
  power_ = PowerControl();
  power_state_ = PowerState::kUnknown;
  tracker_.resume();
  implausible_ = false;
  unconfirmed_us_ = 0;
  mode_display_known_ = false;
}

PowerTarget DriveNode::target(SafetyLevel level, const ActuatorCommand& command) const noexcept {
  // Damping keeps what has torque and enables nothing.
  const PowerTarget kept =
      power_state_ == PowerState::kOperationEnabled ? PowerTarget::kEnabled : PowerTarget::kOff;
  switch (level) {
    case SafetyLevel::kOperational: {
      if (command.mode == DriveMode::kDisabled || !reference_.known) return PowerTarget::kOff;
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
  const double velocity_rad_s = answered() ? tracker_.filtered_velocity_rad_s() : 0.0;
  DriveSetpoint setpoint{0.0, measured_position_rad(), DriveMode::kTorque};
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
  // A drive that has restarted has its default mapping: our set-point would be its control word.
  if (!boot().operational() || gone()) return;
  DriveSetpoint now = setpoint(level, command);
  now.commanded_position_rad -= reference_.offset_rad;
  sent_mode_ = now.mode;
  if (mode_confirmed()) confirmed_at_us_ = time_us;
  unconfirmed_us_ = time_us - confirmed_at_us_;
  out.push(actuator_.bus, profile_->encode_setpoint(now));
  power_.set_target(target(level, command), time_us);
  std::uint16_t word = 0;
  if (power_.step(power_state_, time_us, word)) out.push(actuator_.bus, profile_->encode_control_word(word));
}

}  // namespace sprung
