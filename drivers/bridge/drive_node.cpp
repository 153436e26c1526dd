#include "drivers/bridge/drive_node.h"

#include <cmath>

#include "drivers/canopen/objects.h"
#include "signals/angles.h"

namespace sprung {
namespace {

using cia402::PowerTarget;

double quantum_rad(const ActuatorConfig& actuator) noexcept {
  return 2.0 * kPi / (actuator.encoder_counts_per_turn * actuator.gear_ratio);
}

std::unique_ptr<DriveProfile> make_raw_profile(ActuatorConfig actuator, double cycle_s,
                                               const WatchdogConfig& watchdogs) {
  actuator.offset_rad = 0.0;
  return make_profile(actuator, timing_of(cycle_s, watchdogs));
}

}  // namespace

DriveNode::DriveNode(const ActuatorConfig& actuator, int index, double cycle_s,
                     const WatchdogConfig& watchdogs, const DrivePlant& plant)
    : DriveNode(actuator, index, cycle_s, watchdogs, plant, make_raw_profile(actuator, cycle_s, watchdogs)) {}

DriveNode::DriveNode(const ActuatorConfig& actuator, int index, double cycle_s,
                     const WatchdogConfig& watchdogs, const DrivePlant& plant,
                     std::unique_ptr<DriveProfile> profile)
    : BusNode({actuator.name, actuator.bus, actuator.node, index, watchdogs, actuator.watch,
               actuator.temperature.reading},
              actuator.identity, *profile, true),
      actuator_(actuator),
      profile_(std::move(profile)),
      tracker_(plant.speed_limit_rad_s, quantum_rad(actuator)),
      reference_(actuator),
      background_(*profile_, actuator.emergency_input.bit >= 0,
                  {actuator.position_limits_object, plant.range, actuator.direction / quantum_rad(actuator)},
                  actuator.temperature.reading),
      emergency_input_(actuator.emergency_input),
      stuck_(plant.torque_limit_Nm),
      noise_(plant.torque_limit_Nm, plant.inertia_kg_m2, quantum_rad(actuator), cycle_s),
      impact_(plant.torque_limit_Nm, plant.inertia_kg_m2, cycle_s),
      position_loop_(actuator, cycle_s),
      winding_(actuator.rated_current_A, actuator.winding_time_constant_s) {}

void DriveNode::begin_restore() noexcept {
  if (!actuator_.restore_settings || restore_.begun()) return;
  link().sdo().finish();
  restore_.begin(link().boot().overwritten());
}

void DriveNode::step(std::int64_t time_us, FrameBatch& out) noexcept {
  if (restore_.begun()) {
    CanFrame frame;
    if (restore_.step(time_us, actuator_.node, link().sdo(), frame)) out.push(actuator_.bus, frame);
    return;
  }
  const bool reads = link().boot().operational();
  if (link().step(time_us, out)) reference_.doubt();
  if (!reads || stop_.by_sdo()) return;
  if (reference().known && sampled_)
    background_.position_limits().follow(reference().offset_rad, measured_position_rad(), powered());
  CanFrame frame;
  if (background_.step(time_us, link().sdo(), modes_.unconfirmed_us(), frame)) out.push(actuator_.bus, frame);
  if (const auto display = background_.take_mode()) modes_.read_display(*display);
  if (const auto levels = background_.take_inputs()) emergency_input_.take(*levels);
}

bool DriveNode::receive(const CanFrame& frame, std::int64_t time_us) noexcept {
  const NodeEvents events = link().receive(frame, time_us);
  if (events.maybe_off) reference_.doubt();
  if (events.operational) begin_operation(time_us);
  if (events.sample) take_sample(frame, time_us);
  if (events.other) take_display(frame);
  return events.expected;
}

void DriveNode::begin_operation(std::int64_t time_us) noexcept {
  background_.begin_operation(actuator_.node, time_us);
  modes_.begin_operation(link().boot().mode_display(), time_us);
  background_.position_limits().forget();
}

void DriveNode::take_display(const CanFrame& frame) noexcept {
  std::int8_t display = 0;
  if (profile_->decode_mode_display(frame, display)) modes_.take_display(display);
  std::uint32_t levels = 0;
  if (profile_->decode_inputs(frame, levels)) emergency_input_.take(levels);
}

void DriveNode::take_sample(const CanFrame& frame, std::int64_t time_us) noexcept {
  DriveSample sample;
  if (!profile_->decode_sample(frame, sample)) return;
  power_state_ = cia402::decode_status(sample.status_word);
  power_.observe(power_state_);
  sample_ = sample;
  received_us_ = time_us;
}

void DriveNode::end_sampling() noexcept {
  const bool accepted = link().samples().to_be_judged();
  if (accepted) accept_sample();
  link().end_sampling(accepted);
}

void DriveNode::accept_sample() noexcept {
  const SampleWatch& samples = link().samples();
  winding_.add(sample_.measured_current_A, received_us_);
  if (enabled() && (sample_.status_word & cia402::kInternalLimitBit) != 0) ++limited_by_drive_;
  const Motion motion = tracker_.add(sample_.measured_position_rad,
                                     {samples.sample_sync_us(), samples.earliest_sync_us(), received_us_});
  implausible_ = motion != Motion::kGood;
  if (implausible_) ++implausible_samples_;
  if (enabled()) noise_.add(sample_.measured_position_rad, samples.sample_sync_us());
  watch_impacts(samples.sample_sync_us());
  distrusted_ = distrusted_ || implausible_ || noise_.noisy();
  // Also an absolute encoder's: what it shows from now on is not the place that the reference was found for.
  if (motion == Motion::kJumped) reference_.lose("reference lost: encoder jumped");
  if (impact_.hit()) reference_.lose("reference lost: hit harder than its gear bears");
  sampled_ = true;
}

void DriveNode::watch_impacts(std::int64_t sync_us) noexcept {
  if (!enabled() || implausible_) return;
  impact_.add({sample_.measured_position_rad, measured_link_position_rad_, measured_torque_Nm()}, sync_us);
}

void DriveNode::judge_motion(double mate_rad) noexcept {
  if (!enabled()) {
    noise_.forget();
    impact_.forget();
    return stuck_.forget();
  }
  if (!link().samples().answered() || implausible_) return;
  StuckEncoderInputs in;
  in.time_us = received_us_;
  in.position_rad = sample_.measured_position_rad;
  in.measured_torque_Nm = measured_torque_Nm();
  in.commanded_torque_Nm = commanded_torque_Nm_;
  in.mate_position_rad = mate_rad;
  in.link_position_rad = measured_link_position_rad_;
  stuck_.add(in);
  distrusted_ = distrusted_ || stuck_.stuck();
}

double DriveNode::measured_torque_Nm() const noexcept {
  if (!sampled_) return kNaN;
  return sample_.measured_current_A * actuator_.torque_constant_Nm_A * actuator_.gear_ratio;
}

void DriveNode::show(GateMotion& out) const noexcept {
  const bool fresh = link().samples().answered() && !implausible_;
  out.measured_position_rad = fresh && reference().known ? measured_position_rad() : kNaN;
  out.filtered_velocity_rad_s = fresh && !distrusted_ ? tracker_.filtered_velocity_rad_s() : 0.0;
  out.measured_torque_Nm = measured_torque_Nm();
  out.enabled = enabled();
  out.warm = winding_.warm();
}

std::int64_t DriveNode::encoder_counts() const noexcept {
  return std::llround(actuator_.direction * tracker_.position_rad() / quantum_rad(actuator_));
}

double DriveNode::index_position_rad() const noexcept {
  return actuator_.direction * background_.index_counts() * quantum_rad(actuator_);
}

void DriveNode::set_link_position(double measured_link_position_rad) noexcept {
  measured_link_position_rad_ = measured_link_position_rad;
  const bool comparable = link().samples().answered() && !implausible_ &&
                          std::isfinite(measured_link_position_rad);
  if (comparable) reference_.compare(measured_position_rad(), measured_link_position_rad);
}

bool DriveNode::powered() const noexcept {
  return power_state_ == PowerState::kOperationEnabled || power_state_ == PowerState::kQuickStopActive ||
         power_state_ == PowerState::kFaultReactionActive;
}

bool DriveNode::in_fault() const noexcept {
  return power_state_ == PowerState::kFault || power_state_ == PowerState::kFaultReactionActive;
}

NodeCondition DriveNode::condition() const noexcept {
  return {link().emergencies().stands() || in_fault(), powered(), reference_.loss()};
}

void DriveNode::show(NodeHealth& out) const noexcept {
  reference_.show(out);
  background_.show(out);
  out.implausible_samples = implausible_samples_;
  out.limited_by_drive = limited_by_drive_;
  out.winding_share = winding_.warmth();
}

void DriveNode::fill(ActuatorState& out) const noexcept {
  out.measured_position_rad = sampled_ ? measured_position_rad() : kNaN;
  out.measured_link_position_rad = measured_link_position_rad_;
  out.measured_velocity_rad_s = kNaN;
  out.measured_current_A = sampled_ ? sample_.measured_current_A : kNaN;
  out.measured_supply_V = background_.supply_V();
  out.fault_code = link().emergencies().emergency().code;
  out.age_cycles = link().samples().age_cycles();
  out.power_state = power_state_;
  out.shown_mode = shown_mode();
  out.referenced = reference().known;
}

/// A position loop on the host is in force as soon as the drive shows that it takes torques.
DriveMode DriveNode::shown_mode() const noexcept {
  if (!enabled()) return DriveMode::kDisabled;
  const DriveMode shown = profile_->shown_mode(modes_.display());
  return shown == DriveMode::kTorque && position_loop_.closed() ? DriveMode::kPosition : shown;
}

void DriveNode::reset_faults(bool reset) noexcept {
  power_.reset_faults(reset);
  if (reset) background_.position_limits().retry();
  if (reset) distrusted_ = false;
  if (reset && !in_fault()) link().forget_emergency();
}

void DriveNode::restart() noexcept {
  // One that was silent may have lost its supply and with it an incremental encoder's count.
  if (link().silent() && link().boot().operational()) reference_.doubt();
  link().restart();
  power_ = PowerControl();
  power_state_ = PowerState::kUnknown;
  tracker_.resume();
  implausible_ = distrusted_ = false;
  stop_.forget();
  stuck_.forget();
  noise_.forget();
  impact_.forget();
  emergency_input_.forget();
  modes_.restart();
}

PowerTarget DriveNode::target(SafetyLevel level, const ActuatorCommand& command) const noexcept {
  // Damping keeps what has torque and enables nothing.
  const PowerTarget kept = enabled() ? PowerTarget::kEnabled : PowerTarget::kOff;
  // A drive limits its speed and brakes by its own encoder: by one that is not believed it would drive.
  if (level != SafetyLevel::kOperational && distrusted_) return PowerTarget::kOff;
  switch (level) {
    case SafetyLevel::kOperational: {
      const bool ready = reference().known && (enabled() || background_.position_limits().confirmed());
      if (command.mode == DriveMode::kDisabled || !ready) return PowerTarget::kOff;
      return command.mode == DriveMode::kDamping ? kept : PowerTarget::kEnabled;
    }
    case SafetyLevel::kLowering:
      return command.mode == DriveMode::kDisabled ? PowerTarget::kOff : kept;
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
  // Without a sample of this cycle nothing is known of the motion: an old velocity might drive, not damp. So
  // might that of an encoder that was seen to jump.
  const bool trusted = link().samples().answered() && !distrusted_;
  const double velocity_rad_s = trusted ? tracker_.filtered_velocity_rad_s() : 0.0;
  DriveSetpoint setpoint{0.0, measured_position_rad(), DriveMode::kTorque};
  if (level == SafetyLevel::kQuickStop)
    setpoint.mode = modes_.sent();  // no change of mode in a drive's own stop
  if (obeys(level) && command.mode == DriveMode::kPosition) setpoint.mode = DriveMode::kPosition;
  // Until the drive is enabled: no torque, and the position where it is, so that enabling moves nothing.
  if (!enabled()) return setpoint;
  if (level == SafetyLevel::kDamping) {
    setpoint.commanded_torque_Nm = -actuator_.safety_damping_Nm_s_rad * velocity_rad_s;
  } else if (obeys(level)) {
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

/// Makes a torque of a position set-point, where the drive is not to close that loop. The measurement is of
/// this cycle, as the gate's is; without one the last good one stands until the node counts as silent
/// (watchdogs: silent_cycles).
void DriveNode::close_position_loop(DriveSetpoint& setpoint) noexcept {
  if (setpoint.mode != DriveMode::kPosition) return position_loop_.forget();
  setpoint.mode = DriveMode::kTorque;
  if (!enabled()) return position_loop_.forget();
  setpoint.commanded_torque_Nm = position_loop_.torque_Nm(
      setpoint.commanded_position_rad, measured_position_rad(), tracker_.latest_velocity_rad_s());
}

/// A drive that resets restarts without power; else only an answer of this cycle, or one by SDO, tells.
void DriveNode::watch_stop(std::int64_t time_us, SafetyLevel level, FrameBatch& out) noexcept {
  const bool gone = link().gone();
  StopInputs inputs;
  inputs.time_us = time_us;
  inputs.wanted = severity(level) >= severity(SafetyLevel::kQuickStop) ||
                  (level == SafetyLevel::kDamping && gone);
  inputs.brakes = level == SafetyLevel::kQuickStop;
  if (link().samples().answered() || !inputs.wanted) confirmed_off_ = !powered();
  inputs.seen_off = confirmed_off_ || link().heartbeats().rebooted();
  inputs.takes_pdos = !gone;
  inputs.alive = link().samples().answered() || !link().heartbeats().missing(time_us);
  const bool was_by_sdo = stop_.by_sdo();
  stop_.update(inputs);
  if (stop_.by_sdo() != was_by_sdo) {  // what was asked before is another's
    background_.begin_operation(actuator_.node, time_us);
    link().sdo().finish();
  }
  if (stop_.by_sdo()) stop_by_sdo(time_us, out);
  if (stop_.take_reset(time_us))
    out.push(actuator_.bus, canopen::nmt_frame(canopen::NmtCommand::kResetNode, actuator_.node));
}

/// Writes the control word and reads the status word, in turn.
void DriveNode::stop_by_sdo(std::int64_t time_us, FrameBatch& out) noexcept {
  canopen::SdoClient& sdo = link().sdo();
  if (sdo.status() != canopen::SdoStatus::kBusy) {
    const bool wrote = !sdo.idle() && sdo.object().index == canopen::kControlWord;
    const bool read = sdo.status() == canopen::SdoStatus::kDone && sdo.object().index == canopen::kStatusWord;
    if (read) {
      power_state_ = cia402::decode_status(static_cast<std::uint16_t>(sdo.value()));
      confirmed_off_ = !powered();
    }
    if (wrote) {
      sdo.read({canopen::kStatusWord, 0});
    } else {
      sdo.write({canopen::kControlWord, 0}, cia402::kDisableVoltageWord, 2);
    }
  }
  CanFrame frame;
  if (sdo.step(time_us, frame)) out.push(actuator_.bus, frame);
}

void DriveNode::emit(std::int64_t time_us, SafetyLevel level, const ActuatorCommand& command,
                     FrameBatch& out) noexcept {
  // A drive that has restarted has its default mapping: our set-point would be its control word.
  if (!link().boot().operational()) return stop_.forget();
  watch_stop(time_us, level, out);
  if (link().gone()) return;
  DriveSetpoint now = setpoint(level, command);
  if (actuator_.position_loop == PositionLoopSide::kHost) close_position_loop(now);
  commanded_torque_Nm_ = now.mode == DriveMode::kTorque ? now.commanded_torque_Nm : kNaN;
  now.commanded_position_rad -= reference().offset_rad;
  modes_.send(now.mode, !enabled() || profile_->shown_mode(modes_.display()) == now.mode, time_us);
  out.push(actuator_.bus, profile_->encode_setpoint(now));
  power_.set_target(target(level, command), time_us);
  std::uint16_t word = 0;
  if (power_.step(power_state_, time_us, word)) out.push(actuator_.bus, profile_->encode_control_word(word));
}

}  // namespace sprung
