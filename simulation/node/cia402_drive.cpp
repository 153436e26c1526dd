#include "simulation/node/cia402_drive.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "drivers/canopen/objects.h"
#include "drivers/cia402/words.h"
#include "signals/angles.h"
#include "simulation/hash_noise.h"

namespace sprung::sim {
namespace {

// Error codes of facts canopen 2.5.
constexpr std::uint16_t kOverCurrent = 0x2310;
constexpr std::uint16_t kOverVoltage = 0x3210;
constexpr std::uint16_t kUnderVoltage = 0x3220;
constexpr std::uint16_t kOverTemperature = 0x4210;
// [design choice] a power stage at work, and one beyond what makers let theirs reach (85 of a Gold)
constexpr double kWarm_degC = 40.0;
constexpr double kTooHot_degC = 95.0;
constexpr std::uint16_t kErrorPassive = 0x8120;
constexpr std::uint16_t kMasterLost = 0x8130;
constexpr std::uint16_t kBusOff = 0x81FD;
constexpr std::uint16_t kFollowingError = 0x8611;
/// Set-points of a cyclic mode stay away [U: code of Elmo's "IP underflow"].
constexpr std::uint16_t kSetpointsMissing = 0xFF02;

constexpr std::int64_t kCommunicationBit = 0x10;  ///< of the error register

/// Keeps the numbers of encoder noise apart from those of the other noise sources.
constexpr std::uint64_t kEncoderSignals = 1ULL << 32;

EncoderTruth encoder_truth(const SimDriveSetup& setup) {
  EncoderTruth truth;
  truth.counts_per_turn = setup.actuator.encoder_counts_per_turn;
  if (setup.wiring.given && setup.wiring.encoder_counts_per_turn > 0.0)
    truth.counts_per_turn = setup.wiring.encoder_counts_per_turn;
  truth.gear_ratio = setup.actuator.gear_ratio;
  truth.absolute = setup.truth.absolute_encoder;
  truth.index_rad = setup.truth.index_angle_rad;
  truth.seed = setup.seed;
  truth.signal = kEncoderSignals + setup.signal;
  return truth;
}

/// Codes whose reaction 0x605E chooses; all others take the power off at once (facts canopen 2.5).
bool reacts_by_option(std::uint16_t code) { return code == kFollowingError; }

}  // namespace

Cia402Drive::Cia402Drive(const SimDriveSetup& setup, std::unique_ptr<DriveMake> make)
    : SimDrive(setup.actuator.bus),
      setup_(setup),
      make_(std::move(make)),
      dictionary_(make_->dictionary()),
      device_(setup.actuator.node, dictionary_, *this, outbox(), make_->policy()),
      stage_(make_->power_times(), setup.step_s),
      encoder_(encoder_truth(setup)),
      current_loop_(setup.truth.torque_loop_Hz, setup.step_s),
      gained_loop_(setup.truth.torque_loop_Hz, setup.step_s),
      commutation_(setup.wiring),
      winding_(setup.truth, setup.actuator.gear_ratio, setup.real_winding),
      latches_(setup.truth.latches_communication_faults.value_or(make_->latches_communication_faults())),
      comes_up_in_fault_(setup.truth.starts_in_fault),
      noise_A_(sensor_noise_A(-1)),
      bus_V_(setup.truth.supply_V) {
  if (setup.wiring.given) store(setup.wiring);
}

/// As if somebody had set the drive up before, and stored it.
void Cia402Drive::store(const DriveWiring& wiring) noexcept {
  for (const auto& [id, value] : wiring.stored) {
    if (dictionary_.has(id)) dictionary_.set(id, value);
  }
  dictionary_.store(0, 0xFFFF);
  encoder_.set_fault(FaultKind::kEncoderStuck, 0.0, wiring.encoder_dead);
}

/// The shaft as the encoder and the drive's polarity show it.
double Cia402Drive::seen_rad(double shaft_rad) const noexcept {
  if (!setup_.wiring.given) return shaft_rad;
  return setup_.wiring.encoder_reversed != make_->motor_belief().encoder_inverted ? -shaft_rad : shaft_rad;
}

void Cia402Drive::receive(const CanFrame& frame, std::int64_t time_us) noexcept {
  if (!on_) return;
  device_.receive(frame, time_us);
  canopen::NmtCommand command{};
  const bool nmt = canopen::decode_nmt(frame, setup_.actuator.node, command);
  if (nmt && command == canopen::NmtCommand::kResetCommunication) forget_communication_fault();
}

/// NMT reset communication: from now on a communication fault can be reset (facts canopen 2.5).
void Cia402Drive::forget_communication_fault() noexcept {
  const bool was_latched = std::exchange(communication_fault_, false);
  if (was_latched && !stage_.in_fault()) device_.clear_errors();
}

double Cia402Drive::motor_torque_Nm() const noexcept {
  return setup_.truth.torque_constant_Nm_A * setup_.actuator.gear_ratio * torque_share_ * current_A();
}

void Cia402Drive::sample(double shaft_rad, std::int64_t cycle) noexcept {
  noise_A_ = sensor_noise_A(cycle);
  if (on_) show(encoder_.read(seen_rad(shaft_rad)));
}

void Cia402Drive::step(double shaft_rad, std::int64_t time_us) noexcept {
  turn_winding(shaft_rad);
  if (!on_) return outbox().release(time_us);
  const double counts = encoder_.tick(seen_rad(shaft_rad));
  velocity_rad_s_ = has_counts_ ? (counts - counts_) / encoder_.counts_per_rad() / setup_.step_s : 0.0;
  counts_ = counts;
  has_counts_ = true;
  stage_.advance(velocity_rad_s_);
  supervise();
  change_mode();
  follow_mode();
  if (setup_.wiring.given) commutate(shaft_rad);
  drive_motor();
  show(counts);
  device_.tick(time_us);
}

void Cia402Drive::turn_winding(double shaft_rad) noexcept {
  winding_.turn(has_shaft_ ? (shaft_rad - shaft_rad_) / setup_.step_s : 0.0, torque_share_);
  shaft_rad_ = shaft_rad;
  has_shaft_ = true;
}

/// What the drive finds wrong by itself, and goes on finding while its cause is there.
void Cia402Drive::supervise() noexcept {
  if (stage_.state() == PowerState::kNotReadyToSwitchOn || stage_.in_fault()) return;
  if (std::exchange(comes_up_in_fault_, false)) raise_fault(kErrorPassive);
  if (supply_is_bad()) raise_fault(supply_V() < setup_.truth.supply_min_V ? kUnderVoltage : kOverVoltage);
  if (overheated_) raise_fault(kOverTemperature);
}

bool Cia402Drive::supply_is_bad() const noexcept {
  return supply_V() < setup_.truth.supply_min_V || supply_V() > setup_.truth.supply_max_V;
}

std::uint32_t Cia402Drive::check_write(canopen::ObjectId id, std::int64_t value) noexcept {
  if (id.index != canopen::kMode) return 0;
  return make_->mode_use(static_cast<std::int8_t>(value)) == ModeUse::kRefused ? canopen::kAbortRange : 0;
}

void Cia402Drive::written(canopen::ObjectId id) noexcept {
  if (id.index == canopen::kControlWord) control_word();
  if (id.index != make_->position_object()) return;
  since_setpoint_s_ = 0.0;
  // A drive that extrapolates does so by a clock of its own.
  const double clock_s = extrapolates() ? smoothing_s() : 0.0;
  position_loop_.set_target(static_cast<double>(dictionary_.get({make_->position_object(), 0})), clock_s);
}

int Cia402Drive::option(std::uint16_t index, int otherwise) const noexcept {
  const int position = dictionary_.find({index, 0});
  return position < 0 ? otherwise : static_cast<int>(dictionary_.value(position));
}

PowerOptions Cia402Drive::options() const noexcept {
  return {option(canopen::kQuickStopOption, make_->quick_stop_option()), option(canopen::kShutdownOption, 0),
          option(canopen::kDisableOption, 0), option(canopen::kFaultReactionOption, 0)};
}

bool Cia402Drive::fault_may_be_reset() const noexcept {
  return !communication_fault_ && !supply_is_bad() && !overheated_;
}

void Cia402Drive::control_word() noexcept {
  const bool was_fault = stage_.in_fault();
  const auto word = static_cast<std::uint16_t>(dictionary_.get({canopen::kControlWord, 0}));
  stage_.control(word, options(), velocity_rad_s_, fault_may_be_reset());
  if (!was_fault || stage_.in_fault()) return;
  show_error_code(0);
  device_.clear_errors();
}

/// A mode that is asked for is in force, and confirmed in 0x6061, after the drive's delay.
void Cia402Drive::change_mode() noexcept {
  const auto asked = static_cast<std::int8_t>(dictionary_.get({canopen::kMode, 0}));
  const bool shown = asked == dictionary_.get({canopen::kModeDisplay, 0});
  const ModeUse use = make_->mode_use(asked);
  if (use == ModeUse::kRefused) return;
  if (shown) {
    mode_ = use;
    mode_wait_s_ = 0.0;
    return;
  }
  // Half a tick of tolerance: sums of ticks are not exactly the time.
  if (mode_wait_s_ < setup_.truth.mode_delay_s - 0.5 * setup_.step_s) {
    mode_wait_s_ += setup_.step_s;
    return;
  }
  mode_ = use;
  mode_wait_s_ = 0.0;
  dictionary_.set({canopen::kModeDisplay, 0}, asked);
}

/// The position loop runs while it is in force and operation is enabled.
void Cia402Drive::follow_mode() noexcept {
  const bool position = stage_.state() == PowerState::kOperationEnabled && mode_ == ModeUse::kPosition;
  if (position && !position_active_) {
    position_loop_.enter(counts_);
    since_setpoint_s_ = 0.0;
  }
  position_active_ = position;
  if (!position || stage_.braking()) return;
  reference_ = position_loop_.step(setup_.step_s, smoothing_s(), extrapolates());
  miss_setpoints();
  if (lags_too_far() && !stage_.in_fault()) raise_fault(kFollowingError);
}

bool Cia402Drive::lags_too_far() const noexcept {
  const double furthest_rad = setup_.truth.position_loop.following_error_rad;
  if (furthest_rad <= 0.0) return false;
  return std::abs(reference_.position_counts - counts_) > furthest_rad * encoder_.counts_per_rad();
}

/// The first period is that of the set-point itself.
void Cia402Drive::miss_setpoints() noexcept {
  const double bearable_s = make_->extrapolation_s();
  since_setpoint_s_ += setup_.step_s;
  if (bearable_s <= 0.0) return;
  // Half a tick of tolerance: sums of ticks are not exactly the time.
  if (since_setpoint_s_ > bearable_s + make_->interpolation_period_s() + 0.5 * setup_.step_s)
    raise_fault(kSetpointsMissing);
}

/// Its reference moves by the make's own clock, and so goes on without a set-point. One that is drawn in over
/// a time of its own (SimDriveConfig::smoothing_s) has no such clock.
bool Cia402Drive::extrapolates() const noexcept {
  return setup_.truth.smoothing_s <= 0.0 && make_->extrapolation_s() > 0.0;
}

double Cia402Drive::smoothing_s() const noexcept {
  const double given_s = setup_.truth.smoothing_s;
  return std::max(given_s > 0.0 ? given_s : make_->interpolation_period_s(), setup_.step_s);
}

double Cia402Drive::sensor_noise_A(std::int64_t cycle) const noexcept {
  const double noise_Nm = setup_.truth.torque_noise_Nm * hash_noise(setup_.seed, setup_.signal, cycle);
  return noise_Nm / (setup_.actuator.gear_ratio * setup_.actuator.torque_constant_Nm_A);
}

DriveMoment Cia402Drive::moment(double counts) const noexcept {
  DriveMoment now;
  now.counts = counts;
  now.counts_at_index = encoder_.counts_at_index();
  now.velocity_rad_s = velocity_rad_s_;
  now.measured_current_A = setup_.truth.current_sensor.gain * current_A() + noise_A_ + sensor_offset_A();
  now.supply_V = supply_V();
  now.power_stage_degC = overheated_ ? kTooHot_degC : kWarm_degC;
  now.dt_s = setup_.step_s;
  now.counts_per_rad = encoder_.counts_per_rad();
  now.mode = mode_;
  now.powered = stage_.powered();
  now.braking = stage_.braking();
  now.emergency_stop = emergency_stop_;
  now.reference = reference_;
  return now;
}

void Cia402Drive::drive_motor() noexcept {
  const CurrentDemand demand = make_->demand(moment(counts_));
  limited_ = demand.limited;
  if (!demand.on) {
    switch_off_current();
  } else {
    // The loop brings the sensor to the set-point, as far as voltage reaches.
    const double true_A = (demand.current_A - sensor_offset_A()) / setup_.truth.current_sensor.gain;
    const double reached_A = winding_.reachable_A(true_A, supply_V());
    limited_ = limited_ || reached_A != true_A;
    step_current(reached_A);
  }
  if (demand.fault != 0 && !stage_.in_fault()) raise_fault(demand.fault);
}

double Cia402Drive::sensor_offset_A() const noexcept {
  return setup_.truth.current_sensor.offset_A + current_offset_A_;
}

double Cia402Drive::current_A() const noexcept {
  return setup_.wiring.given ? gained_loop_.current_A() : current_loop_.current_A();
}

void Cia402Drive::switch_off_current() noexcept {
  current_loop_.switch_off();
  gained_loop_.switch_off();
}

void Cia402Drive::step_current(double target_A) noexcept {
  if (!setup_.wiring.given) {
    current_loop_.step(target_A);
    return;
  }
  const DriveWiring& wiring = setup_.wiring;
  const MotorBelief belief = make_->motor_belief();
  const bool told = wiring.fitting_p > 0.0 && belief.current_p + belief.current_i > 0.0;
  const double gain_p = told ? belief.current_p / wiring.fitting_p : wiring.gain_p;
  const double gain_i = told ? belief.current_i / wiring.fitting_i : wiring.gain_i;
  gained_loop_.step(target_A, gain_p, gain_i, setup_.wiring.voltage_A);
}

/// The Hall sensors are read when power comes on; from then on the encoder is counted.
void Cia402Drive::commutate(double shaft_rad) noexcept {
  const double motor_rad = shaft_rad * setup_.actuator.gear_ratio;
  if (!stage_.powered()) commutation_.align(motor_rad, counts_);
  torque_share_ = commutation_.share(motor_rad, counts_, make_->motor_belief(),
                                     encoder_.counts_per_rad() * kTurn_rad / setup_.actuator.gear_ratio);
}

void Cia402Drive::show(double counts) noexcept {
  const DriveMoment now = moment(counts);
  make_->show(now);
  int word = make_->status_word(stage_, now);
  if (device_.operational()) word |= cia402::kRemoteBit;
  if (limited_) word |= cia402::kInternalLimitBit;
  dictionary_.set({canopen::kStatusWord, 0}, word);
}

void Cia402Drive::show_error_code(std::uint16_t code) noexcept {
  const int position = dictionary_.find({canopen::kErrorCode, 0});
  if (position >= 0) dictionary_.set({canopen::kErrorCode, 0}, code);
}

void Cia402Drive::raise_fault(std::uint16_t code) noexcept {
  const bool brakes = reacts_by_option(code) && option(canopen::kFaultReactionOption, 0) != 0;
  stage_.fault(brakes, velocity_rad_s_);
  show_error_code(code);
  device_.raise(code);
}

void Cia402Drive::connection_lost() noexcept {
  const bool by_error = (device_.errors().error_register() & kCommunicationBit) != 0;
  communication_fault_ = communication_fault_ || (by_error && latches_);
  stage_.connection_lost(option(canopen::kAbortConnectionOption, 0), options(), velocity_rad_s_);
}

void Cia402Drive::connection_back() noexcept {
  if (!stage_.in_fault() && !communication_fault_) device_.clear_errors();
}

void Cia402Drive::reset() noexcept {
  stage_.reset();
  make_->reset();
  position_loop_ = PositionLoop();
  position_active_ = false;
  mode_ = ModeUse::kNone;
  mode_wait_s_ = 0.0;
  communication_fault_ = false;
  switch_off_current();
}

void Cia402Drive::set_fault(FaultKind kind, double value, bool on) noexcept {
  encoder_.set_fault(kind, value, on);
  switch (kind) {
    case FaultKind::kOverCurrent:
      if (on) raise_fault(kOverCurrent);
      return;
    case FaultKind::kUnderVoltage:
      forced_supply_V_.reset();
      if (on) forced_supply_V_ = value > 0.0 ? value : 0.5 * setup_.truth.supply_min_V;
      return;
    case FaultKind::kOverTemperature:
      overheated_ = on;
      return;
    case FaultKind::kEmergencyInput:
      emergency_stop_ = on && !setup_.wiring.emergency_dead;
      return;
    case FaultKind::kCurrentOffset:
      current_offset_A_ = on ? value : 0.0;
      return;
    case FaultKind::kBusOff:
    case FaultKind::kLinkDown:
      if (!on) tell_again();
      return;
    case FaultKind::kPowerCycle:
      return switch_power(!on);
    default:
      return;
  }
}

/// Back on the bus: a CAN controller repeats what nobody has heard until somebody does.
void Cia402Drive::tell_again() noexcept {
  for (const std::uint16_t code : {kBusOff, kMasterLost}) {
    if (!device_.errors().stands(code)) continue;
    device_.clear(code);
    device_.raise(code);
  }
}

void Cia402Drive::switch_power(bool on) noexcept {
  on_ = on;
  switch_off_current();
  if (!on) return;
  encoder_.power_on();
  has_counts_ = false;
  comes_up_in_fault_ = setup_.truth.starts_in_fault;
  device_.power_cycle();
}

}  // namespace sprung::sim
