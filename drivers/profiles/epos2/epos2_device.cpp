#include "drivers/profiles/epos2/epos2_device.h"

#include <algorithm>
#include <cmath>

#include "drivers/canopen/eds.h"
#include "drivers/canopen/objects.h"
#include "drivers/cia402/words.h"
#include "drivers/profiles/epos2/epos2_units.h"
#include "signals/angles.h"
#include "simulation/device_registry.h"
#include "sprung_embedded/epos2_eds_extra_text.h"
#include "sprung_embedded/epos2_eds_text.h"

namespace sprung::sim {
namespace {

using namespace epos2;

constexpr std::uint16_t kFollowingErrorFault = 0x8611;
constexpr std::uint16_t kPositionLimitFault = 0xFF09;
constexpr std::int64_t kNeverTooFar = 0xFFFFFFFF;  ///< of 0x6065

/// 0x6502: profile position and profile velocity. A real one says more, but homing and interpolated position
/// are not simulated, and what a drive refuses it should not offer. The maker's own modes have no bit there.
constexpr std::int64_t kSimulatedModes = 1 << (kModeProfilePosition - 1) | 1 << (kModeProfileVelocity - 1);

// Objects that only this device shows.
constexpr std::uint16_t kCurrentAveraged = 0x2027;   ///< mA
constexpr std::uint16_t kVelocityAveraged = 0x2028;  ///< rpm
constexpr std::uint16_t kCurrentDemand = 0x2031;     ///< mA
constexpr std::uint16_t kFollowingError = 0x20F4;    ///< qc, i16
constexpr std::uint16_t kPositionDemand = 0x6062;    ///< qc
constexpr std::uint16_t kVelocitySensor = 0x6069;    ///< qc/s
constexpr std::uint16_t kVelocityActual = 0x606C;    ///< rpm

// Status word bits that CiA 402 leaves to the maker (facts canopen 2.2).
constexpr std::uint16_t kOffsetMeasuredBit = 1U << 8;
constexpr std::uint16_t kRefreshBit = 1U << 14;

ObjectDictionary epos2_dictionary(const SimDriveSetup& setup) {
  const canopen::Eds eds = canopen::parse_eds(epos2_eds_text(), "epos2.eds", setup.actuator.node,
                                              epos2_eds_extra_text());
  const double pulses = std::clamp(setup.actuator.encoder_counts_per_turn / 4.0, 16.0, 2.5e6);
  // No two devices have the same identity, else LSS could not tell them apart.
  const int serial = (setup.actuator.bus + 1) * 1000 + setup.actuator.node;
  return ObjectDictionary(eds, {{{kEncoderPulses, 1}, std::llround(pulses)},
                                {{canopen::kIdentity, 4}, serial},
                                {{canopen::kSupportedModes, 0}, kSimulatedModes}});
}

double clamp_i32(double value) { return std::clamp(value, -2147483648.0, 2147483647.0); }
double clamp_i16(double value) { return std::clamp(value, -32768.0, 32767.0); }
/// A counter of 32 bits wraps.
double wrap_u32(double value) { return static_cast<std::uint32_t>(std::llround(value)); }

}  // namespace

Epos2Make::Epos2Make(const SimDriveSetup& setup)
    : setup_(setup),
      dictionary_(epos2_dictionary(setup)),
      rpm_per_rad_s_(setup.actuator.gear_ratio * 60.0 / kTurn_rad),
      motion_(dictionary_, rpm_per_rad_s_) {}

double Epos2Make::object(std::uint16_t index, std::uint8_t sub) const noexcept {
  return static_cast<double>(dictionary_.get({index, sub}));
}

void Epos2Make::show(std::uint16_t index, double value) noexcept {
  dictionary_.set({index, 0}, std::llround(value));
}

ModeUse Epos2Make::mode_use(std::int8_t code) const noexcept {
  switch (code) {
    case kModePosition:
      return ModeUse::kPosition;
    case kModeCurrent:
      return ModeUse::kCurrent;
    case kModeVelocity:
      return ModeUse::kVelocity;
    case kModeProfilePosition:
      return ModeUse::kProfilePosition;
    case kModeProfileVelocity:
      return ModeUse::kProfileVelocity;
    default:
      return ModeUse::kRefused;
  }
}

std::uint16_t Epos2Make::position_object() const noexcept { return kPositionSetting; }

/// Both [unverified]: facts canopen 1.5, 2.5.
DevicePolicy Epos2Make::policy() const noexcept {
  DevicePolicy policy;
  policy.remap_in_operational = canopen::kAbortMaxonNmtState;
  policy.short_pdo_loses_connection = true;
  policy.lss = true;  // its EDS says so
  policy.factory_node = setup_.truth.factory_node;
  return policy;
}

void Epos2Make::reset() noexcept {
  thermal_.reset();
  warm_ = false;
  average_current_A_ = 0.0;
  average_rad_s_ = 0.0;
  motion_.forget();
}

MotorBelief Epos2Make::motor_belief() const noexcept {
  MotorBelief belief;
  belief.pole_pairs = static_cast<int>(object(kMotorData, 3));
  belief.encoder_counts_per_turn = 4.0 * object(kEncoderPulses, 1);
  belief.encoder_inverted = (dictionary_.get({kEncoderPulses, kSensorPolaritySub}) & 1) != 0;
  belief.current_p = object(kCurrentRegulator, 1);
  belief.current_i = object(kCurrentRegulator, 2);
  return belief;
}

double Epos2Make::position_current_A(const PositionLoop::Reference& reference,
                                     const DriveMoment& now) noexcept {
  const double error_qc = reference.position_counts - now.counts;
  const double error_qc_s = reference.velocity_counts_s - now.velocity_rad_s * now.counts_per_rad;
  show(kPositionDemand, clamp_i32(reference.position_counts));
  show(kFollowingError, clamp_i16(error_qc));
  const PositionLoopConfig& truth = setup_.truth.position_loop;
  const double stiffness_mA_qc = truth.stiffness_share * kProportionalUnit_mA_qc *
                                 object(kPositionRegulator, 1);
  const double damping_mA_s_qc = truth.damping_share * kDerivativeUnit_mA_s_qc *
                                 object(kPositionRegulator, 3);
  return 1e-3 * (stiffness_mA_qc * error_qc + damping_mA_s_qc * error_qc_s);
}

double Epos2Make::desired_current_A(const DriveMoment& now) noexcept {
  const ActuatorConfig& actuator = setup_.actuator;
  const double brake_A_s_rad = setup_.truth.quick_stop_damping_Nm_s_rad /
                               (actuator.gear_ratio * actuator.torque_constant_Nm_A);
  if (now.braking) return -brake_A_s_rad * now.velocity_rad_s;
  if (Epos2Motion::drives(now.mode)) return position_current_A(motion_.reference(), now);
  if (now.mode == ModeUse::kPosition) return position_current_A(now.reference, now);
  return now.mode == ModeUse::kCurrent ? 1e-3 * object(kCurrentSetting) : 0.0;
}

/// Peak, or continuous when warm, or what the power stage can.
double Epos2Make::limit_A(const DriveMoment& now) noexcept {
  const double continuous_A = 1e-3 * object(kMotorData, 1);
  const double peak_A = 1e-3 * object(kMotorData, 2);
  const double time_constant_s = kThermalUnit_s * object(kMotorData, 5);
  warm_ = thermal_.step(now.measured_current_A, continuous_A, time_constant_s, now.dt_s);
  const double stage_A = setup_.truth.peak_torque_Nm /
                         (setup_.actuator.gear_ratio * setup_.truth.torque_constant_Nm_A);
  return std::min({warm_ ? continuous_A : peak_A, peak_A, stage_A});
}

bool Epos2Make::lags_too_far(const DriveMoment& now) const noexcept {
  const bool profile = now.mode == ModeUse::kProfilePosition;
  if ((now.mode != ModeUse::kPosition && !profile) || now.braking) return false;
  const std::int64_t furthest_qc = dictionary_.get({kMaxFollowingError, 0});
  const PositionLoop::Reference& reference = profile ? motion_.reference() : now.reference;
  const double error_qc = std::abs(reference.position_counts - now.counts);
  return furthest_qc != kNeverTooFar && error_qc > static_cast<double>(furthest_qc);
}

bool Epos2Make::beyond_limits(const DriveMoment& now) const noexcept {
  return now.counts < object(kPositionLimits, 1) || now.counts > object(kPositionLimits, 2);
}

void Epos2Make::average(const DriveMoment& now) noexcept {
  const double share = now.dt_s / kAverage_s;
  average_current_A_ += share * (now.measured_current_A - average_current_A_);
  average_rad_s_ += share * (now.velocity_rad_s - average_rad_s_);
}

CurrentDemand Epos2Make::demand(const DriveMoment& now) noexcept {
  average(now);
  motion_.step(now);
  const double limit = limit_A(now);  // also without power: the winding cools
  if (!now.powered) {
    show(kCurrentDemand, 0.0);
    return {};
  }
  if (beyond_limits(now)) return {false, 0.0, false, kPositionLimitFault};
  if (lags_too_far(now)) return {false, 0.0, false, kFollowingErrorFault};
  const double desired_A = desired_current_A(now);
  const double cap_rad_s = object(kMotorData, 4) / rpm_per_rad_s_;
  const double current_A = limit_torque(desired_A, limit, now.velocity_rad_s, cap_rad_s);
  show(kCurrentDemand, clamp_i16(1e3 * current_A));
  return {true, current_A, warm_ || current_A != desired_A};
}

void Epos2Make::show(const DriveMoment& now) noexcept {
  show(canopen::kPositionActual, clamp_i32(now.counts));
  show(kEncoderCounter, wrap_u32(now.counts));
  show(kCounterAtIndex, wrap_u32(now.counts_at_index));
  show(canopen::kCurrentActual, clamp_i16(1e3 * now.measured_current_A));
  show(kCurrentAveraged, clamp_i16(1e3 * average_current_A_));
  show(kVelocityActual, rpm_per_rad_s_ * now.velocity_rad_s);
  show(kVelocityAveraged, rpm_per_rad_s_ * average_rad_s_);
  show(kVelocitySensor, clamp_i32(now.velocity_rad_s * now.counts_per_rad));
  const EmergencyInputConfig& input = setup_.actuator.emergency_input;
  const bool high = input.bit >= 0 && now.emergency_stop == input.stops_high;
  dictionary_.set({kDigitalInputState, 1}, high ? 0xFFFF : 0);
}

/// The 12 words of facts canopen 2.2.
std::uint16_t Epos2Make::status_word(const PowerStage& stage, const DriveMoment& now) const noexcept {
  if (stage.extra() == PowerExtra::kStart) return 0;
  const bool refreshes = stage.extra() == PowerExtra::kRefresh || stage.extra() == PowerExtra::kMeasure;
  const bool stage_on = stage.powered() || stage.extra() == PowerExtra::kMeasure;
  const bool reached = stage.state() == PowerState::kOperationEnabled && now.mode == ModeUse::kPosition &&
                       std::abs(now.reference.position_counts - now.counts) <= kTargetWindow_qc;
  int word = cia402::encode_status(stage.state()) & ~cia402::kVoltageEnabledBit;
  word |= kOffsetMeasuredBit;
  if (stage_on) word |= cia402::kVoltageEnabledBit;
  if (refreshes) word |= kRefreshBit;
  if (reached) word |= cia402::kTargetReachedBit;
  word |= motion_.status_bits(now);
  return static_cast<std::uint16_t>(word);
}

}  // namespace sprung::sim

namespace sprung::profiles {

extern const sim::DeviceKind epos2_device_kind{
    "epos2",
    [](const sim::SimDriveSetup& setup) -> std::unique_ptr<sim::SimDrive> {
      return std::make_unique<sim::Epos2Drive>(setup);
    },
    nullptr};

}  // namespace sprung::profiles
