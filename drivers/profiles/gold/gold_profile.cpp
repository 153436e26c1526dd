#include "drivers/profiles/gold/gold_profile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "drivers/canopen/objects.h"
#include "drivers/cia402/words.h"
#include "drivers/profiles/gold/gold_units.h"
#include "drivers/profiles/profile_registry.h"
#include "drivers/profiles/profile_values.h"
#include "sprung_embedded/gold_eds_extra_text.h"
#include "sprung_embedded/gold_eds_text.h"

namespace sprung::gold {
namespace {

using namespace sprung::profiles;

constexpr std::int16_t kPowerOff = 2;         ///< 0x6007: disable voltage when the bridge's heartbeat is lost
constexpr std::int16_t kSlowDownThenOff = 2;  ///< 0x605A: quick stop ramp, then switch on disabled
constexpr int kLargestMaxTorque = 50000;      ///< EDS limit of 0x6072
/// [design choice] The mode is shown at every so many SYNCs, since what an asynchronous TPDO of a Gold is
/// sent for is the maker's own affair (0x2F20). At every SYNC it would take single_leg's bus over its 80 %;
/// nothing in the loop waits for it.
constexpr double kDisplayPeriod_s = 0.007;
constexpr std::uint8_t kSamplePdo = 0, kSetpointPdo = 0, kControlPdo = 1;
constexpr std::uint32_t kVendor = 0x9A, kProduct = 0x00030923, kRevision = 0x000103F6;  ///< facts canopen 3

/// Of 0x6502.
constexpr std::uint32_t bit_of_mode(std::int8_t mode) noexcept { return 1U << (mode - 1); }

/// @return 1..240: a transmission type.
std::uint8_t syncs_in(double time_s, double cycle_s) {
  return static_cast<std::uint8_t>(
      std::clamp(std::round(time_s / cycle_s), 1.0, double{canopen::kTypeSyncMax}));
}

/// 0x60C2: seconds = value * 10^exponent, value 1..255.
struct InterpolationPeriod {
  std::uint8_t value = 0;
  std::int8_t exponent = 0;
};

InterpolationPeriod interpolation_period(double cycle_s) {
  for (const int exponent : {-3, -4, -5, -6, -2}) {
    const double value = cycle_s / std::pow(10.0, exponent);
    const double whole = std::round(value);
    if (whole >= 1.0 && whole <= 255.0 && std::abs(value - whole) < 1e-6) {
      return {static_cast<std::uint8_t>(whole), static_cast<std::int8_t>(exponent)};
    }
  }
  throw std::invalid_argument("cycle of " + std::to_string(cycle_s) +
                              " s cannot be told to a Gold drive (0x60C2)");
}

}  // namespace

GoldProfile::GoldProfile(const ActuatorConfig& actuator, const DriveTiming& timing)
    : DriveProfile(actuator.node, actuator.emergency_input), actuator_(actuator), timing_(timing) {
  rated_torque_mNm_ = to_object(1e3 * actuator.torque_constant_Nm_A * actuator.rated_current_A,
                                owner(actuator), "rated torque");
  if (rated_torque_mNm_ == 0 || !(actuator.gear_ratio > 0.0) || !(actuator.encoder_counts_per_turn > 0.0)) {
    throw std::invalid_argument(owner(actuator) + ": rated torque, gear ratio or encoder counts are zero");
  }
  rated_torque_Nm_ = 1e-3 * rated_torque_mNm_;
  counts_per_rad_ = actuator.direction * actuator.encoder_counts_per_turn * actuator.gear_ratio / (2.0 * kPi);
  if (actuator.position_gains_object != 0) {
    throw std::invalid_argument(
        owner(actuator) +
        ": a Gold over CAN has no object for position gains that sprung knows (0x2F01 is its user's own "
        "array): "
        "tune its loop with the maker's tool and leave position_loop.object out, or write closed_by: host");
  }
  const double permille = 1e3 * actuator.torque_limit_Nm / (actuator.gear_ratio * rated_torque_Nm_);
  max_torque_permille_ = to_integer(
      permille, 0.0, std::min<int>(kLargestMaxTorque, std::numeric_limits<std::int16_t>::max()));
  (void)interpolation_period(timing.cycle_s);  // refuse now rather than while booting
}

/// Set-points, states and limits of a Gold are CiA 402's: without 0x2F75 it runs as well, it only bears fewer
/// lost set-points in its position mode.
KnownDevice GoldProfile::known_device() const { return {kVendor, kProduct, {kRevision}, 0xFFFFFFFF, true}; }

std::uint32_t GoldProfile::required_modes() const noexcept {
  const bool by_drive = actuator_.position_loop == PositionLoopSide::kDrive;
  return bit_of_mode(cia402::kModeCyclicTorque) | (by_drive ? bit_of_mode(cia402::kModeCyclicPosition) : 0U);
}

std::vector<DriveSetting> GoldProfile::settings() const {
  const InterpolationPeriod period = interpolation_period(timing_.cycle_s);
  std::vector<DriveSetting> settings = {
      heartbeat_producer(timing_, owner(actuator_)),
      heartbeat_consumer(timing_, owner(actuator_)),
      i16({canopen::kAbortConnectionOption, 0}, kPowerOff),
      i16({canopen::kQuickStopOption, 0}, kSlowDownThenOff),
      u32({canopen::kRatedCurrent, 0},
          to_object(1e3 * actuator_.rated_current_A, owner(actuator_), "rated current")),
      u32({canopen::kRatedTorque, 0}, rated_torque_mNm_),
      u16({canopen::kMaxTorque, 0}, static_cast<std::uint32_t>(max_torque_permille_)),
      i16({canopen::kTorqueOffset, 0}, 0),  // what a former master left would be added to every set-point
      u8({canopen::kInterpolationPeriod, 1}, period.value),
      i8({canopen::kInterpolationPeriod, 2}, period.exponent),
      u32({canopen::kSyncPeriod, 0}, to_object(1e6 * timing_.cycle_s, owner(actuator_), "cycle")),
      u16({kExtrapolationCycles, 0}, static_cast<std::uint32_t>(timing_.lost_setpoints)),
  };
  add_speed_limit(settings);
  return settings;
}

std::vector<DriveSetting> GoldProfile::guarding_instead() const {
  return guarding_settings(timing_, owner(actuator_));
}

/// Second line behind the torque's own limits; unverified that a Gold heeds it in cyclic torque mode.
void GoldProfile::add_speed_limit(std::vector<DriveSetting>& settings) const {
  if (actuator_.speed_limit_object == 0) return;
  const double speed_rpm = actuator_.speed_limit_rad_s * actuator_.gear_ratio * 60.0 / (2.0 * kPi);
  settings.push_back(
      u32({actuator_.speed_limit_object, 0}, to_object(speed_rpm, owner(actuator_), "speed limit")));
}

std::vector<PdoSetting> GoldProfile::pdos() const {
  std::vector<PdoSetting> pdos = {
      {true,
       kSamplePdo,
       canopen::kTypeEverySync,
       {{{canopen::kPositionActual, 0}, 32},
        {{canopen::kTorqueActual, 0}, 16},
        {{canopen::kStatusWord, 0}, 16}}},
      {true, kDisplayPdo, syncs_in(kDisplayPeriod_s, timing_.cycle_s), display_entries()},
      {false,
       kSetpointPdo,
       canopen::kTypeEvent,
       {{{canopen::kTargetTorque, 0}, 16}, {{canopen::kTargetPosition, 0}, 32}, {{canopen::kMode, 0}, 8}}},
      {false, kControlPdo, canopen::kTypeEvent, {{{canopen::kControlWord, 0}, 16}}},
  };
  for (int number = 2; number < canopen::kPdoCount; ++number) {
    pdos.push_back({true, number, canopen::kTypeEvent, {}});
    pdos.push_back({false, number, canopen::kTypeEvent, {}});
  }
  return pdos;
}

canopen::ObjectId GoldProfile::supply_voltage_object() const noexcept { return {canopen::kSupplyVoltage, 0}; }

bool GoldProfile::decode_sample(const CanFrame& frame, DriveSample& sample) const noexcept {
  if (frame.id != canopen::tpdo_id(kSamplePdo, actuator_.node) || frame.length != 8) return false;
  sample.measured_position_rad = get_i32(&frame.data[0]) / counts_per_rad_ + actuator_.offset_rad;
  sample.measured_current_A = actuator_.direction * 1e-3 * get_i16(&frame.data[4]) * rated_torque_Nm_ /
                              actuator_.torque_constant_Nm_A;
  sample.status_word = static_cast<std::uint16_t>(canopen::get_le(&frame.data[6], 2));
  return true;
}

canopen::MapEntry GoldProfile::inputs() const noexcept { return {{canopen::kDigitalInputs, 0}, 32}; }

DriveMode GoldProfile::shown_mode(std::int8_t code) const noexcept {
  if (code == cia402::kModeCyclicPosition) return DriveMode::kPosition;
  if (code == cia402::kModeCyclicTorque) return DriveMode::kTorque;
  return DriveMode::kDisabled;
}

CanFrame GoldProfile::encode_setpoint(const DriveSetpoint& setpoint) const noexcept {
  const double limit = max_torque_permille_;
  const double permille = 1e3 * actuator_.direction * setpoint.commanded_torque_Nm /
                          (actuator_.gear_ratio * rated_torque_Nm_);
  const double counts = (setpoint.commanded_position_rad - actuator_.offset_rad) * counts_per_rad_;
  const bool position = setpoint.mode == DriveMode::kPosition;
  CanFrame frame;
  frame.id = canopen::rpdo_id(kSetpointPdo, actuator_.node);
  frame.length = 7;
  canopen::put_le(&frame.data[0], static_cast<std::uint32_t>(to_integer(permille, -limit, limit)), 2);
  canopen::put_le(&frame.data[2],
                  static_cast<std::uint32_t>(to_integer(counts, std::numeric_limits<std::int32_t>::min(),
                                                        std::numeric_limits<std::int32_t>::max())),
                  4);
  frame.data[6] = static_cast<std::uint8_t>(position ? cia402::kModeCyclicPosition
                                                     : cia402::kModeCyclicTorque);
  return frame;
}

CanFrame GoldProfile::encode_control_word(std::uint16_t word) const noexcept {
  CanFrame frame;
  frame.id = canopen::rpdo_id(kControlPdo, actuator_.node);
  frame.length = 2;
  canopen::put_le(&frame.data[0], word, 2);
  return frame;
}

}  // namespace sprung::gold

namespace sprung::profiles {

extern const ProfileKind gold_profile_kind{
    "gold",
    [](const ActuatorConfig& actuator, const DriveTiming& timing) -> std::unique_ptr<DriveProfile> {
      return std::make_unique<gold::GoldProfile>(actuator, timing);
    },
    nullptr, gold_eds_text, gold_eds_extra_text};

}  // namespace sprung::profiles
