#include "drivers/profiles/gold/gold_device.h"

#include <algorithm>
#include <cmath>

#include "drivers/canopen/objects.h"
#include "drivers/profiles/gold/gold_device_objects.h"
#include "drivers/profiles/gold/gold_units.h"
#include "drivers/sim/device_registry.h"
#include "drivers/sim/hash_noise.h"

namespace sprung::sim {
namespace {

constexpr double kTwoPi = 6.283185307179586;
/// Quick stop ends without power when slower than this, or after this long [design choice].
constexpr double kQuickStopSpeed_rad_s = 0.05;
constexpr double kQuickStopTime_s = 0.1;

std::uint32_t rounded(double value) { return static_cast<std::uint32_t>(std::lround(value)); }

GoldCommissioning commissioning(const SimDriveSetup& config) {
  const ActuatorConfig& actuator = config.actuator;
  GoldCommissioning gold;
  gold.node = actuator.node;
  gold.rated_current_mA = rounded(1e3 * actuator.rated_current_A);
  gold.rated_torque_mNm = rounded(1e3 * actuator.rated_current_A * actuator.torque_constant_Nm_A);
  gold.max_motor_speed_rpm = rounded(actuator.speed_limit_rad_s * actuator.gear_ratio * 60.0 / kTwoPi);
  gold.supply_mV = rounded(1e3 * config.truth.supply_V);
  return gold;
}

}  // namespace

GoldDrive::GoldDrive(const SimDriveSetup& config)
    : SimDrive(config.actuator.bus),
      config_(config),
      dictionary_(gold_dictionary(commissioning(config))),
      device_(config.actuator.node, dictionary_, *this, outbox()),
      current_loop_(config.truth.torque_loop_Hz, config.step_s),
      counts_per_rad_(config.actuator.encoder_counts_per_turn * config.actuator.gear_ratio / kTwoPi) {}

double GoldDrive::object(std::uint16_t index, std::uint8_t sub) const noexcept {
  return static_cast<double>(dictionary_.get({index, sub}));
}

void GoldDrive::show(std::uint16_t index, double value) noexcept {
  dictionary_.set({index, 0}, std::llround(value));
}

double GoldDrive::counts(double shaft_rad) const noexcept { return std::floor(shaft_rad * counts_per_rad_); }

/// By the ratings in the drive; 0 while they are not set.
double GoldDrive::believed_constant_Nm_A() const noexcept {
  const double rated_mA = object(canopen::kRatedCurrent);
  return rated_mA > 0.0 ? object(canopen::kRatedTorque) / rated_mA : 0.0;
}

double GoldDrive::per_mille_to_Nm(double per_mille) const noexcept {
  return 1e-6 * per_mille * object(canopen::kRatedTorque) * config_.actuator.gear_ratio;
}

double GoldDrive::interpolation_period_s() const noexcept {
  double period_s = object(canopen::kInterpolationPeriod, 1);
  const auto exponent = dictionary_.get({canopen::kInterpolationPeriod, 2});
  for (std::int64_t power = exponent; power < 0; ++power) period_s *= 0.1;
  return std::max(period_s, config_.step_s);
}

bool GoldDrive::powered() const noexcept {
  return state_ == PowerState::kOperationEnabled || state_ == PowerState::kQuickStopActive;
}

double GoldDrive::motor_torque_Nm() const noexcept {
  return config_.truth.torque_constant_Nm_A * config_.actuator.gear_ratio * current_loop_.current_A();
}

void GoldDrive::sample(double shaft_rad, std::int64_t cycle) noexcept {
  cycle_ = cycle;
  show(canopen::kPositionActual, counts(shaft_rad));
  show_torque(cycle);
  show_status();
}

void GoldDrive::step(double shaft_rad, std::int64_t time_us) noexcept {
  const double counts_now = counts(shaft_rad);
  velocity_rad_s_ = has_counts_ ? (counts_now - counts_) / counts_per_rad_ / config_.step_s : 0.0;
  counts_ = counts_now;
  has_counts_ = true;
  advance_state();
  change_mode(counts_now);
  drive_motor();
  show(canopen::kPositionActual, counts_now);
  show(kVelocityActual, std::clamp(velocity_rad_s_ * counts_per_rad_, -2147483648.0, 2147483647.0));
  show_torque(cycle_);
  show_status();
  device_.tick(time_us);
}

void GoldDrive::written(canopen::ObjectId id) noexcept {
  if (id.index == canopen::kControlWord) control_word();
  if (id.index == canopen::kTargetPosition) position_loop_.set_target(object(canopen::kTargetPosition));
}

void GoldDrive::control_word() noexcept {
  const auto word = static_cast<std::uint16_t>(dictionary_.get({canopen::kControlWord, 0}));
  const PowerState before = state_;
  state_ = cia402::apply_control(before, word, last_control_word_);
  last_control_word_ = word;
  if (before == PowerState::kFault && state_ != PowerState::kFault) {
    show(canopen::kErrorCode, 0.0);
    device_.clear_errors();
  }
  if (before != PowerState::kQuickStopActive && state_ == PowerState::kQuickStopActive) quick_stop();
}

/// 0x605A: 0 = power off at once, else brake first.
void GoldDrive::quick_stop() noexcept {
  const bool brakes = object(canopen::kQuickStopOption) != 0.0 && velocity_rad_s_ != 0.0;
  state_ = brakes ? PowerState::kQuickStopActive : PowerState::kSwitchOnDisabled;
  quick_stop_s_ = 0.0;
}

/// Transitions that the drive makes by itself.
void GoldDrive::advance_state() noexcept {
  if (state_ == PowerState::kNotReadyToSwitchOn) state_ = PowerState::kSwitchOnDisabled;
  if (state_ == PowerState::kFaultReactionActive) state_ = PowerState::kFault;
  if (state_ != PowerState::kQuickStopActive) return;
  quick_stop_s_ += config_.step_s;
  const bool slow = std::abs(velocity_rad_s_) < kQuickStopSpeed_rad_s;
  if (slow || quick_stop_s_ > kQuickStopTime_s) state_ = PowerState::kSwitchOnDisabled;
}

void GoldDrive::change_mode(double counts) noexcept {
  const auto mode = static_cast<std::int8_t>(dictionary_.get({canopen::kMode, 0}));
  const bool known = mode == cia402::kModeCyclicPosition || mode == cia402::kModeCyclicTorque;
  if (known || mode == cia402::kModeNone) dictionary_.set({canopen::kModeDisplay, 0}, mode);
  const bool position = state_ == PowerState::kOperationEnabled &&
                        dictionary_.get({canopen::kModeDisplay, 0}) == cia402::kModeCyclicPosition;
  if (position && !position_active_) position_loop_.enter(counts);
  position_active_ = position;
}

double GoldDrive::position_torque_Nm() noexcept {
  const PositionLoop::Reference reference = position_loop_.step(config_.step_s, interpolation_period_s());
  const double stiffness = gold::kStiffnessUnit_Nm_rad * object(canopen::kPositionGains, gold::kStiffnessSub);
  const double damping = gold::kDampingUnit_Nm_s_rad * object(canopen::kPositionGains, gold::kDampingSub);
  const double error_counts = reference.position_counts - counts_;
  show(kFollowingError, std::clamp(error_counts, -2147483648.0, 2147483647.0));
  return stiffness * error_counts / counts_per_rad_ +
         damping * (reference.velocity_counts_s / counts_per_rad_ - velocity_rad_s_);
}

double GoldDrive::desired_torque_Nm() noexcept {
  if (state_ == PowerState::kQuickStopActive)
    return -config_.truth.quick_stop_damping_Nm_s_rad * velocity_rad_s_;
  const double offset_Nm = per_mille_to_Nm(object(canopen::kTorqueOffset));
  if (position_active_) return offset_Nm + position_torque_Nm();
  if (dictionary_.get({canopen::kModeDisplay, 0}) != cia402::kModeCyclicTorque) return 0.0;
  return offset_Nm + per_mille_to_Nm(object(canopen::kTargetTorque));
}

void GoldDrive::drive_motor() noexcept {
  const double constant = believed_constant_Nm_A() * config_.actuator.gear_ratio;
  limited_ = false;
  if (!powered() || constant <= 0.0) {
    show(kTorqueDemand, 0.0);
    return current_loop_.switch_off();
  }
  const double set_limit_Nm = per_mille_to_Nm(object(canopen::kMaxTorque));
  const double limit_Nm = std::min(set_limit_Nm, config_.truth.peak_torque_Nm);
  const double cap_rad_s = object(canopen::kMaxMotorSpeed) * kTwoPi / 60.0 / config_.actuator.gear_ratio;
  const double desired_Nm = desired_torque_Nm();
  const double torque_Nm = limit_torque(desired_Nm, limit_Nm, velocity_rad_s_, cap_rad_s);
  limited_ = torque_Nm != desired_Nm;
  const double demand = torque_Nm / std::max(per_mille_to_Nm(1.0), 1e-9);
  show(kTorqueDemand, std::clamp(demand, -32768.0, 32767.0));
  current_loop_.step(torque_Nm / constant);
}

void GoldDrive::show_status() noexcept {
  int word = cia402::encode_status(state_);
  if (device_.operational()) word |= cia402::kRemoteBit;
  if (limited_) word |= cia402::kInternalLimitBit;
  dictionary_.set({canopen::kStatusWord, 0}, word);
}

/// 0x6077 and 0x6078: what the current sensor says, in per mille of the ratings.
void GoldDrive::show_torque(std::int64_t cycle) noexcept {
  const ActuatorConfig& actuator = config_.actuator;
  const double noise_Nm = config_.truth.torque_noise_Nm * hash_noise(config_.seed, config_.signal, cycle);
  const double noise_A = noise_Nm / (actuator.gear_ratio * actuator.torque_constant_Nm_A);
  const double rated_A = 1e-3 * object(canopen::kRatedCurrent);
  const double per_mille = rated_A > 0.0 ? 1e3 * (current_loop_.current_A() + noise_A) / rated_A : 0.0;
  const double shown = std::clamp(per_mille, -32768.0, 32767.0);
  show(canopen::kTorqueActual, shown);
  show(canopen::kCurrentActual, shown);
}

void GoldDrive::set_fault(FaultKind kind, double /*value*/, bool on) noexcept {
  if (on && kind == FaultKind::kOverCurrent) raise_fault(0x2310);
}

void GoldDrive::raise_fault(std::uint16_t code) noexcept {
  state_ = PowerState::kFaultReactionActive;
  dictionary_.set({canopen::kErrorCode, 0}, code);
  device_.raise(code);
}

/// 0x6007: 0 nothing, 1 fault, 2 disable voltage, 3 quick stop (facts canopen 2.6). A drive without power
/// stays as it is.
void GoldDrive::connection_lost() noexcept {
  const auto option = dictionary_.get({canopen::kAbortConnectionOption, 0});
  const bool has_voltage =
      powered() || state_ == PowerState::kSwitchedOn || state_ == PowerState::kReadyToSwitchOn;
  if (!has_voltage || option == 0) return;
  if (option == 1) {
    state_ = PowerState::kFaultReactionActive;
  } else if (option == 3 && powered()) {
    quick_stop();
  } else {
    state_ = PowerState::kSwitchOnDisabled;
  }
}

void GoldDrive::connection_back() noexcept {
  const bool faulted = state_ == PowerState::kFault || state_ == PowerState::kFaultReactionActive;
  if (!faulted) device_.clear_errors();
}

void GoldDrive::reset() noexcept {
  state_ = PowerState::kNotReadyToSwitchOn;
  last_control_word_ = 0;
  position_loop_ = PositionLoop();
  position_active_ = false;
  current_loop_.switch_off();
}

}  // namespace sprung::sim

namespace sprung::profiles {

extern const sim::DeviceKind gold_device_kind{
    "gold",
    [](const sim::SimDriveSetup& setup) -> std::unique_ptr<sim::SimDrive> {
      return std::make_unique<sim::GoldDrive>(setup);
    },
    nullptr};

}  // namespace sprung::profiles
