/// What an EPOS2 must have been told before it may turn a motor: objects of facts canopen 2.4; StarlETH's
/// driver writes 0x6402, 0x2210:02, :04 and 0x60F6 at each start.
#include <cmath>

#include "drivers/canopen/objects.h"
#include "drivers/profiles/epos2/epos2_profile.h"
#include "drivers/profiles/epos2/epos2_units.h"
#include "drivers/profiles/profile_values.h"

namespace sprung::epos2 {
namespace {

using namespace sprung::profiles;
using Topic = CommissioningTopic;

constexpr std::uint16_t kSensorKind = 0x000F;  ///< low nibble of 0x2210:02
constexpr std::uint16_t kPolarityOfEncoder1 = 0x0001;
constexpr std::uint8_t kPolePairsSub = 3;

std::string typed(double value, const char* key) {
  return std::to_string(std::llround(value)) + " (" + key + " of robot.yaml)";
}

CommissioningObject exactly(Topic topic, canopen::ObjectId object, int size, std::int64_t value,
                            std::string expected) {
  CommissioningObject out;
  out.topic = topic;
  out.object = object;
  out.size = size;
  out.low = out.high = value;
  out.expected = std::move(expected);
  out.may_be_written = true;
  return out;
}

CommissioningObject motor_type(MotorKind motor) {
  switch (motor) {
    case MotorKind::kSinusoidal:
      return exactly(Topic::kMotor, {kMotorType, 0}, 2, 10, "10, brushless, sinusoidal");
    case MotorKind::kBlock:
      return exactly(Topic::kMotor, {kMotorType, 0}, 2, 11, "11, brushless, block");
    case MotorKind::kBrushed:
      return exactly(Topic::kMotor, {kMotorType, 0}, 2, 1, "1, brushed");
    case MotorKind::kBrushless:
      break;
  }
  CommissioningObject out = exactly(Topic::kMotor, {kMotorType, 0}, 2, 10, "10 or 11, brushless");
  out.high = 11;
  return out;
}

void add_current_gains(const CommissioningConfig& wanted, std::vector<CommissioningObject>& out) {
  const int values[] = {wanted.current_p, wanted.current_i};
  for (std::uint8_t sub = 1; sub <= 2; ++sub) {
    CommissioningObject gain = exactly(Topic::kCurrentLoop, {kCurrentRegulator, sub}, 2, values[sub - 1],
                                       typed(values[sub - 1], "current_gains"));
    gain.is_signed = true;
    if (values[sub - 1] == 0) {
      gain.low = 1;
      gain.high = 32767;
      gain.expected = "above 0; robot.yaml has no current_gains: the current step decides";
      gain.may_be_written = false;
    }
    out.push_back(gain);
  }
}

/// Codes that the sources agree on (facts canopen 2.4); -1: none.
int bit_rate_code(double bit_rate_bit_s) {
  const double rates[] = {1e6, 8e5, 5e5, 2.5e5, 1.25e5};
  for (int code = 0; code < 5; ++code) {
    if (rates[code] == bit_rate_bit_s) return code;
  }
  return -1;
}

}  // namespace

CommissioningPlan Epos2Profile::commissioning(double bit_rate_bit_s) const {
  CommissioningPlan plan;
  const CommissioningConfig& wanted = actuator_.commissioning;
  std::vector<CommissioningObject>& objects = plan.objects;
  objects.push_back(exactly(Topic::kNodeId, {kNodeId, 0}, 1, actuator_.node, typed(actuator_.node, "node")));
  objects.push_back(motor_type(wanted.motor));
  if (actuator_.pole_pairs != 0)
    objects.push_back(exactly(Topic::kMotor, {kMotorData, kPolePairsSub}, 1, actuator_.pole_pairs,
                              typed(actuator_.pole_pairs, "pole_pairs")));
  const double pulses = actuator_.encoder_counts_per_turn / 4.0;
  objects.push_back(exactly(Topic::kEncoder, {kEncoderPulses, 1}, 4, std::llround(pulses),
                            typed(pulses, "pulses, encoder_counts / 4")));
  CommissioningObject sensor = exactly(Topic::kEncoder, {kEncoderPulses, kSensorTypeSub}, 2, 1,
                                       "1 or 2, incremental encoder");
  sensor.mask = kSensorKind;
  sensor.high = 2;
  objects.push_back(sensor);
  CommissioningObject polarity = exactly(
      Topic::kEncoder, {kEncoderPulses, kSensorPolaritySub}, 2, wanted.encoder_inverted ? 1 : 0,
      wanted.encoder_inverted ? "bit 0 set (encoder_inverted)" : "bit 0 clear");
  polarity.mask = kPolarityOfEncoder1;
  objects.push_back(polarity);
  add_current_gains(wanted, objects);
  objects.push_back(exactly(Topic::kLimits, {kMotorData, 1}, 2, std::llround(1e3 * actuator_.rated_current_A),
                            typed(1e3 * actuator_.rated_current_A, "mA, rated_current")));
  objects.push_back(exactly(Topic::kLimits, {kMotorData, 2}, 2, peak_current_mA_,
                            typed(peak_current_mA_, "mA, torque_limit")));
  if (actuator_.speed_limit_object != 0) {
    const double speed_rpm = actuator_.speed_limit_rad_s * actuator_.gear_ratio * 60.0 / (2.0 * kPi);
    objects.push_back(exactly(Topic::kLimits, {kMotorData, 4}, 4, std::llround(speed_rpm),
                              typed(speed_rpm, "rpm, speed_limit")));
  }
  if (const int code = bit_rate_code(bit_rate_bit_s); code >= 0)
    objects.push_back(exactly(Topic::kBitRate, {kBitRateCode, 0}, 2, code, typed(code, "code for bit_rate")));
  plan.torque_mode = kModeCurrent;
  plan.setpoint = {kCurrentSetting, 0};
  plan.A_per_setpoint = 1e-3;
  plan.measured_current = {canopen::kCurrentActual, 0};
  plan.A_per_measured = 1e-3;
  plan.position = {canopen::kPositionActual, 0};
  plan.rad_per_count = actuator_.direction / qc_per_rad_;
  plan.inputs = {kDigitalInputState, 1};
  plan.last_error = {canopen::kErrorHistory, 1};
  return plan;
}

}  // namespace sprung::epos2
