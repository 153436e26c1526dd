/// What a Gold must have been told before it may turn a motor. Its motor and encoder are set by commands
/// (CA[], KP[], KI[]) of its own interpreter, which over CAN stands behind 0x1023 and 0x2012. What it answers
/// is not confirmed, so sprung does not speak it: commissioning finds them by hand and by a small current.
#include <cmath>

#include "drivers/canopen/objects.h"
#include "drivers/cia402/words.h"
#include "drivers/profiles/gold/gold_profile.h"
#include "drivers/profiles/profile_values.h"

namespace sprung::gold {
namespace {

using namespace sprung::profiles;

CommissioningObject limit(std::uint16_t index, int size, double value, const char* unit_and_key) {
  CommissioningObject out;
  out.topic = CommissioningTopic::kLimits;
  out.object = {index, 0};
  out.size = size;
  out.low = out.high = std::llround(value);
  out.expected = std::to_string(out.low) + " " + unit_and_key;
  out.may_be_written = true;
  return out;
}

}  // namespace

CommissioningPlan GoldProfile::commissioning(double /*bit_rate_bit_s*/) const {
  CommissioningPlan plan;
  plan.objects.push_back(
      limit(canopen::kRatedCurrent, 4, 1e3 * actuator_.rated_current_A, "mA (rated_current of robot.yaml)"));
  plan.objects.push_back(
      limit(canopen::kRatedTorque, 4, rated_torque_mNm_, "mNm (torque_constant x rated_current)"));
  plan.objects.push_back(
      limit(canopen::kMaxTorque, 2, max_torque_permille_, "per mille of rated torque (torque_limit)"));
  if (actuator_.speed_limit_object != 0) {
    const double speed_rpm = actuator_.speed_limit_rad_s * actuator_.gear_ratio * 60.0 / (2.0 * kPi);
    plan.objects.push_back(limit(actuator_.speed_limit_object, 4, speed_rpm, "rpm (speed_limit)"));
  }
  plan.not_readable =
      "a Gold shows motor type, pole pairs (CA[19]), encoder counts (CA[18]) and current gains (KP[1], "
      "KI[1]) by its interpreter, which sprung does not speak: compare them in the maker's tool; by hand and "
      "by a small current they are found below";
  plan.torque_mode = cia402::kModeCyclicTorque;
  plan.setpoint = {canopen::kTargetTorque, 0};
  plan.A_per_setpoint = 1e-3 * rated_torque_Nm_ / actuator_.torque_constant_Nm_A;
  plan.measured_current = {canopen::kCurrentActual, 0};
  plan.A_per_measured = 1e-3 * actuator_.rated_current_A;
  plan.position = {canopen::kPositionActual, 0};
  plan.rad_per_count = 1.0 / counts_per_rad_;
  plan.inputs = {canopen::kDigitalInputs, 0};
  plan.last_error = {canopen::kErrorCode, 0};
  return plan;
}

}  // namespace sprung::gold
