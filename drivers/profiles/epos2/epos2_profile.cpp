#include "drivers/profiles/epos2/epos2_profile.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "drivers/canopen/objects.h"
#include "drivers/profiles/epos2/epos2_units.h"
#include "drivers/profiles/profile_registry.h"
#include "drivers/profiles/profile_values.h"
#include "sprung_embedded/epos2_eds_extra_text.h"
#include "sprung_embedded/epos2_eds_text.h"

namespace sprung::epos2 {
namespace {

using namespace sprung::profiles;

// Limits of the EDS, facts canopen 2.4.
constexpr int kLargestContinuous_mA = 5000;
constexpr int kLargestPeak_mA = 10000;
constexpr double kFewestPulses = 16, kMostPulses = 2.5e6;
constexpr double kLargestSpeed_rpm = 25000;
constexpr double kLargestGain = 32767;
constexpr int kInputBits = 16;            ///< of 0x2071:01
constexpr double kLargestThermal = 5400;  ///< in kThermalUnit_s

constexpr std::uint32_t kVendor = 0xFB, kProduct = 0x63220000;  ///< EPOS2 50/5, facts canopen 1.6
constexpr std::uint32_t kSoftware = 0xFFFF0000;                 ///< of the revision
constexpr std::int16_t kPowerOff = 2;  ///< 0x6007: disable voltage; coding of CiA 402, unverified for EPOS2
constexpr std::int16_t kDisableDrive = 0;  ///< 0x605B, 0x605C, 0x605E
/// [design choice] A mode display waits this long at most: 0x1800:03, 10 ms. An EPOS2 has no event timer to
/// repeat it.
constexpr std::uint16_t kDisplayInhibit_100us = 100;
/// [design choice] A position set-point may be this many times further off than where the loop asks for all
/// the torque that there is; further, and something blocks.
constexpr double kFollowingErrorShare = 4.0;
constexpr std::uint8_t kVelocityFeedForwardSub = 4, kAccelerationFeedForwardSub = 5;
constexpr int kSamplePdo = 0, kSetpointPdo = 0, kControlPdo = 1;

void refuse(const ActuatorConfig& actuator, const std::string& problem) {
  throw std::invalid_argument(owner(actuator) + ": " + problem);
}

void refuse_impossible(const ActuatorConfig& a) {
  if (!(a.gear_ratio > 0.0) || !(a.torque_constant_Nm_A > 0.0))
    refuse(a, "gear ratio or torque constant is zero");
  const double pulses = a.encoder_counts_per_turn / 4.0;
  if (pulses < kFewestPulses || pulses > kMostPulses || pulses != std::floor(pulses))
    refuse(a, "encoder_counts must be 4 times 16 to 2500000 whole pulses (0x2210:01)");
  if (a.speed_limit_object != 0 && a.speed_limit_object != kMotorData)
    refuse(a, "an EPOS2 takes its speed limit in 0x6410: speed_limit_object must be that or 0");
  if (a.position_gains_object != 0 && a.position_gains_object != kPositionRegulator)
    refuse(a, "an EPOS2 takes its position gains in 0x60FB: position_loop.object must be that or 0");
  if (a.position_limits_object != 0 && a.position_limits_object != kPositionLimits)
    refuse(a, "an EPOS2 takes its position limits in 0x607D: position_limits_object must be that or 0");
  if (a.emergency_input.bit >= kInputBits)
    refuse(a, "an EPOS2 shows 16 inputs in 0x2071:01: emergency_input.bit must be 0 to 15");
}

}  // namespace

Epos2Profile::Epos2Profile(const ActuatorConfig& actuator, const DriveTiming& timing)
    : DriveProfile(actuator.node, actuator.emergency_input), actuator_(actuator), timing_(timing) {
  refuse_impossible(actuator);
  mA_per_Nm_ = 1e3 / (actuator.gear_ratio * actuator.torque_constant_Nm_A);
  qc_per_rad_ = actuator.encoder_counts_per_turn * actuator.gear_ratio / (2.0 * kPi);
  const double peak_mA = mA_per_Nm_ * actuator.torque_limit_Nm;
  if (!(peak_mA >= 0.0 && peak_mA <= kLargestPeak_mA))
    refuse(actuator, "torque_limit needs " + std::to_string(1e-3 * peak_mA) +
                         " A, an EPOS2 50/5 gives 10 A: at most " +
                         std::to_string(kLargestPeak_mA / mA_per_Nm_) + " Nm");
  peak_current_mA_ = to_integer(peak_mA, 0.0, kLargestPeak_mA);
  if (1e3 * actuator.rated_current_A > kLargestContinuous_mA)
    refuse(actuator, "rated_current: an EPOS2 50/5 gives 5 A for long");
  (void)settings();  // refuse now rather than while booting
}

/// Of these two the maker's files are at hand. Its modes and set-points are the maker's own: on another
/// firmware nothing of it can be used.
KnownDevice Epos2Profile::known_device() const {
  return {kVendor, kProduct, {0x21260000, 0x21200000}, kSoftware, false};
}

std::vector<DriveSetting> Epos2Profile::settings() const {
  std::vector<DriveSetting> settings = {
      heartbeat_producer(timing_, owner(actuator_)),
      heartbeat_consumer(timing_, owner(actuator_)),
      i16({canopen::kAbortConnectionOption, 0}, kPowerOff),
      // In current mode there is no ramp to follow: whatever ends operation, ends the current.
      i16({canopen::kShutdownOption, 0}, kDisableDrive),
      i16({canopen::kDisableOption, 0}, kDisableDrive),
      i16({canopen::kFaultReactionOption, 0}, kDisableDrive),
      u32({kEncoderPulses, 1},
          to_object(actuator_.encoder_counts_per_turn / 4.0, owner(actuator_), "encoder_counts")),
  };
  add_motor(settings);
  add_position_loop(settings);
  return settings;
}

void Epos2Profile::add_motor(std::vector<DriveSetting>& settings) const {
  const std::string who = owner(actuator_);
  settings.push_back(u16({kMotorData, 1}, to_object(1e3 * actuator_.rated_current_A, who, "rated_current",
                                                    kLargestContinuous_mA)));
  settings.push_back(u16({kMotorData, 2}, static_cast<std::uint32_t>(peak_current_mA_)));
  if (actuator_.pole_pairs != 0)
    settings.push_back(u8({kMotorData, 3}, static_cast<std::uint8_t>(actuator_.pole_pairs)));
  if (actuator_.speed_limit_object != 0) {
    const double speed_rpm = actuator_.speed_limit_rad_s * actuator_.gear_ratio * 60.0 / (2.0 * kPi);
    settings.push_back(u32({kMotorData, 4}, to_object(speed_rpm, who, "speed_limit", kLargestSpeed_rpm)));
  }
  if (actuator_.winding_time_constant_s > 0.0) {
    const double units = actuator_.winding_time_constant_s / kThermalUnit_s;
    settings.push_back(u16({kMotorData, 5}, to_object(units, who, "winding_time_constant", kLargestThermal)));
  }
}

/// The drive's own integrator and feed-forwards stay out: the loop is to be the spring and damper that
/// robot.yaml names.
void Epos2Profile::add_position_loop(std::vector<DriveSetting>& settings) const {
  if (actuator_.position_gains_object == 0) return;
  const std::string who = owner(actuator_);
  const double mA_per_gain = mA_per_Nm_ / qc_per_rad_;
  const double stiffness = actuator_.position_stiffness_Nm_rad;
  const std::uint32_t gains[] = {
      to_object(stiffness * mA_per_gain / kProportionalUnit_mA_qc, who, "position stiffness", kLargestGain),
      0,
      to_object(actuator_.position_damping_Nm_s_rad * mA_per_gain / kDerivativeUnit_mA_s_qc, who,
                "position damping", kLargestGain)};
  std::uint8_t sub = 0;
  for (const std::uint32_t gain : gains)
    settings.push_back(i16({kPositionRegulator, ++sub}, static_cast<std::int16_t>(gain)));
  settings.push_back(u16({kPositionRegulator, kVelocityFeedForwardSub}, 0));
  settings.push_back(u16({kPositionRegulator, kAccelerationFeedForwardSub}, 0));
  if (!(stiffness > 0.0)) return;
  const double furthest_qc = kFollowingErrorShare * actuator_.torque_limit_Nm / stiffness * qc_per_rad_;
  settings.push_back(u32({kMaxFollowingError, 0}, to_object(furthest_qc, who, "following error")));
}

std::vector<PdoSetting> Epos2Profile::pdos() const {
  PdoSetting display{true, kDisplayPdo, canopen::kTypeEvent, display_entries()};
  display.inhibit_100us = kDisplayInhibit_100us;
  std::vector<PdoSetting> pdos = {
      {true,
       kSamplePdo,
       canopen::kTypeEverySync,
       {{{canopen::kPositionActual, 0}, 32},
        {{canopen::kCurrentActual, 0}, 16},
        {{canopen::kStatusWord, 0}, 16}}},
      display,
      {false,
       kSetpointPdo,
       canopen::kTypeEvent,
       {{{kCurrentSetting, 0}, 16}, {{kPositionSetting, 0}, 32}, {{canopen::kMode, 0}, 8}}},
      {false, kControlPdo, canopen::kTypeEvent, {{{canopen::kControlWord, 0}, 16}}},
  };
  for (int number = 2; number < canopen::kPdoCount; ++number) {
    pdos.push_back({true, number, canopen::kTypeEvent, {}});
    pdos.push_back({false, number, canopen::kTypeEvent, {}});
  }
  return pdos;
}

double Epos2Profile::supply_V(std::uint32_t) const noexcept {
  return std::numeric_limits<double>::quiet_NaN();
}

bool Epos2Profile::decode_sample(const CanFrame& frame, DriveSample& sample) const noexcept {
  if (frame.id != canopen::tpdo_id(kSamplePdo, actuator_.node) || frame.length != 8) return false;
  const double direction = actuator_.direction;
  sample.measured_position_rad = direction * get_i32(&frame.data[0]) / qc_per_rad_ + actuator_.offset_rad;
  sample.measured_current_A = direction * 1e-3 * get_i16(&frame.data[4]);
  sample.status_word = static_cast<std::uint16_t>(canopen::get_le(&frame.data[6], 2));
  return true;
}

canopen::MapEntry Epos2Profile::inputs() const noexcept { return {{kDigitalInputState, 1}, 16}; }

DriveMode Epos2Profile::shown_mode(std::int8_t code) const noexcept {
  if (code == kModePosition) return DriveMode::kPosition;
  if (code == kModeCurrent) return DriveMode::kTorque;
  return DriveMode::kDisabled;
}

CanFrame Epos2Profile::encode_setpoint(const DriveSetpoint& setpoint) const noexcept {
  const double direction = actuator_.direction;
  const double limit = peak_current_mA_;
  const double current_mA = direction * setpoint.commanded_torque_Nm * mA_per_Nm_;
  const double position_qc = direction * (setpoint.commanded_position_rad - actuator_.offset_rad) *
                             qc_per_rad_;
  const bool position = setpoint.mode == DriveMode::kPosition;
  CanFrame frame;
  frame.id = canopen::rpdo_id(kSetpointPdo, actuator_.node);
  frame.length = 7;
  put_i16(&frame.data[0], to_integer(current_mA, -limit, limit));
  put_i32(&frame.data[2], to_integer(position_qc, std::numeric_limits<std::int32_t>::min(),
                                     std::numeric_limits<std::int32_t>::max()));
  frame.data[6] = static_cast<std::uint8_t>(position ? kModePosition : kModeCurrent);
  return frame;
}

CanFrame Epos2Profile::encode_control_word(std::uint16_t word) const noexcept {
  CanFrame frame;
  frame.id = canopen::rpdo_id(kControlPdo, actuator_.node);
  frame.length = 2;
  canopen::put_le(&frame.data[0], word, 2);
  return frame;
}

}  // namespace sprung::epos2

namespace sprung::profiles {

extern const ProfileKind epos2_profile_kind{
    "epos2",
    [](const ActuatorConfig& actuator, const DriveTiming& timing) -> std::unique_ptr<DriveProfile> {
      return std::make_unique<epos2::Epos2Profile>(actuator, timing);
    },
    nullptr, epos2_eds_text, epos2_eds_extra_text};

}  // namespace sprung::profiles
