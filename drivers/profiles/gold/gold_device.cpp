#include "drivers/profiles/gold/gold_device.h"

#include <algorithm>
#include <cmath>

#include "drivers/canopen/eds.h"
#include "drivers/canopen/objects.h"
#include "drivers/cia402/words.h"
#include "drivers/profiles/gold/gold_units.h"
#include "signals/angles.h"
#include "simulation/device_registry.h"
#include "sprung_embedded/gold_eds_extra_text.h"
#include "sprung_embedded/gold_eds_text.h"

namespace sprung::sim {
namespace {

std::uint32_t rounded(double value) { return static_cast<std::uint32_t>(std::lround(value)); }

GoldCommissioning commissioning(const SimDriveSetup& setup) {
  const ActuatorConfig& actuator = setup.actuator;
  GoldCommissioning gold;
  gold.node = actuator.node;
  gold.rated_current_mA = rounded(1e3 * actuator.rated_current_A);
  gold.rated_torque_mNm = rounded(1e3 * actuator.rated_current_A * actuator.torque_constant_Nm_A);
  gold.max_motor_speed_rpm = rounded(actuator.speed_limit_rad_s * actuator.gear_ratio * 60.0 / kTurn_rad);
  gold.supply_mV = rounded(1e3 * setup.truth.supply_V);
  return gold;
}

double clamp_i32(double value) { return std::clamp(value, -2147483648.0, 2147483647.0); }
double clamp_i16(double value) { return std::clamp(value, -32768.0, 32767.0); }

}  // namespace

ObjectDictionary gold_dictionary(const GoldCommissioning& commissioning) {
  const std::vector<ObjectValue> values = {
      {{canopen::kIdentity, 3}, commissioning.revision},
      {{canopen::kIdentity, 4}, commissioning.serial},
      {{canopen::kRatedCurrent, 0}, commissioning.rated_current_mA},
      {{canopen::kRatedTorque, 0}, commissioning.rated_torque_mNm},
      {{canopen::kMaxMotorSpeed, 0}, commissioning.max_motor_speed_rpm},
      {{canopen::kSupplyVoltage, 0}, commissioning.supply_mV},
  };
  return ObjectDictionary(
      canopen::parse_eds(gold_eds_text(), "gold.eds", commissioning.node, gold_eds_extra_text()), values);
}

GoldMake::GoldMake(const SimDriveSetup& setup)
    : setup_(setup), dictionary_(gold_dictionary(commissioning(setup))) {}

double GoldMake::object(std::uint16_t index, std::uint8_t sub) const noexcept {
  return static_cast<double>(dictionary_.get({index, sub}));
}

void GoldMake::show(std::uint16_t index, double value) noexcept {
  dictionary_.set({index, 0}, std::llround(value));
}

ModeUse GoldMake::mode_use(std::int8_t code) const noexcept {
  if (code == cia402::kModeCyclicPosition) return ModeUse::kPosition;
  if (code == cia402::kModeCyclicTorque) return ModeUse::kCurrent;
  return code == cia402::kModeNone ? ModeUse::kNone : ModeUse::kRefused;
}

std::uint16_t GoldMake::position_object() const noexcept { return canopen::kTargetPosition; }

double GoldMake::interpolation_period_s() const noexcept {
  double period_s = object(canopen::kInterpolationPeriod, 1);
  const auto exponent = dictionary_.get({canopen::kInterpolationPeriod, 2});
  for (std::int64_t power = exponent; power < 0; ++power) period_s *= 0.1;
  return period_s;
}

DevicePolicy GoldMake::policy() const noexcept {
  DevicePolicy policy;
  policy.events_on_change = false;  // 0x2F20
  return policy;
}

double GoldMake::extrapolation_s() const noexcept {
  return object(gold::kExtrapolationCycles) * interpolation_period_s();
}

/// By the ratings in the drive; 0 while they are not set.
double GoldMake::believed_constant_Nm_A() const noexcept {
  const double rated_mA = object(canopen::kRatedCurrent);
  return rated_mA > 0.0 ? object(canopen::kRatedTorque) / rated_mA : 0.0;
}

double GoldMake::per_mille_to_Nm(double per_mille) const noexcept {
  return 1e-6 * per_mille * object(canopen::kRatedTorque) * setup_.actuator.gear_ratio;
}

/// As tuned with the maker's tool, to what robot.yaml says or near it.
double GoldMake::position_torque_Nm(const DriveMoment& now) noexcept {
  const double error_counts = now.reference.position_counts - now.counts;
  show(kFollowingError, clamp_i32(error_counts));
  const ActuatorConfig& tuned = setup_.actuator;
  const PositionLoopConfig& truth = setup_.truth.position_loop;
  return truth.stiffness_share * tuned.position_stiffness_Nm_rad * error_counts / now.counts_per_rad +
         truth.damping_share * tuned.position_damping_Nm_s_rad *
             (now.reference.velocity_counts_s / now.counts_per_rad - now.velocity_rad_s);
}

double GoldMake::desired_torque_Nm(const DriveMoment& now) noexcept {
  if (now.braking) return -setup_.truth.quick_stop_damping_Nm_s_rad * now.velocity_rad_s;
  const double offset_Nm = per_mille_to_Nm(object(canopen::kTorqueOffset));
  if (now.mode == ModeUse::kPosition) return offset_Nm + position_torque_Nm(now);
  if (now.mode != ModeUse::kCurrent) return 0.0;
  return offset_Nm + per_mille_to_Nm(object(canopen::kTargetTorque));
}

CurrentDemand GoldMake::demand(const DriveMoment& now) noexcept {
  const double constant = believed_constant_Nm_A() * setup_.actuator.gear_ratio;
  if (!now.powered || constant <= 0.0) {
    show(kTorqueDemand, 0.0);
    return {};
  }
  const double limit_Nm = std::min(per_mille_to_Nm(object(canopen::kMaxTorque)), setup_.truth.peak_torque_Nm);
  const double cap_rad_s = object(canopen::kMaxMotorSpeed) * kTurn_rad / 60.0 / setup_.actuator.gear_ratio;
  const double desired_Nm = desired_torque_Nm(now);
  const double torque_Nm = limit_torque(desired_Nm, limit_Nm, now.velocity_rad_s, cap_rad_s);
  show(kTorqueDemand, clamp_i16(torque_Nm / std::max(per_mille_to_Nm(1.0), 1e-9)));
  return {true, torque_Nm / constant, torque_Nm != desired_Nm};
}

void GoldMake::show(const DriveMoment& now) noexcept {
  show(canopen::kPositionActual, now.counts);
  show(kVelocityActual, clamp_i32(now.velocity_rad_s * now.counts_per_rad));
  const double rated_A = 1e-3 * object(canopen::kRatedCurrent);
  const double shown = clamp_i16(rated_A > 0.0 ? 1e3 * now.measured_current_A / rated_A : 0.0);
  show(canopen::kTorqueActual, shown);
  show(canopen::kCurrentActual, shown);
  show(canopen::kSupplyVoltage, 1e3 * now.supply_V);
  show(kDriveTemperature, now.power_stage_degC);
  const EmergencyInputConfig& input = setup_.actuator.emergency_input;
  const bool high = input.bit >= 0 && now.emergency_stop == input.stops_high;
  show(canopen::kDigitalInputs, high ? 0xFFFFFFFF : 0);
}

std::uint16_t GoldMake::status_word(const PowerStage& stage, const DriveMoment& /*now*/) const noexcept {
  return cia402::encode_status(stage.state());
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
