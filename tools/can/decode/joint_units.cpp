#include "tools/can/decode/joint_units.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "drivers/canopen/objects.h"
#include "signals/angles.h"

namespace sprung::cantools {
namespace {

/// Measured from the drive's own zero, so robot.yaml's offset belongs to them; a following error, say, is a
/// difference. With 0x6062, 0x6063: demand and internal value; 0x2062: EPOS2's position mode setting.
bool is_absolute_position(canopen::ObjectId object) {
  constexpr std::array<std::uint16_t, 5> kAbsolute{0x2062, 0x6062, 0x6063, canopen::kPositionActual,
                                                   canopen::kTargetPosition};
  return std::find(kAbsolute.begin(), kAbsolute.end(), object.index) != kAbsolute.end();
}

/// As the profiles write it to 0x6076: whole mNm.
double rated_torque_Nm(const ActuatorConfig& actuator) {
  return 1e-3 *
         static_cast<double>(std::llround(1e3 * actuator.torque_constant_Nm_A * actuator.rated_current_A));
}

std::vector<JointValue> current(const ActuatorConfig& actuator, double current_A) {
  return {{current_A, "A"}, {current_A * actuator.torque_constant_Nm_A * actuator.gear_ratio, "Nm"}};
}

}  // namespace

std::vector<JointValue> in_joint_units(const ActuatorConfig& actuator, canopen::ObjectId object,
                                       const std::string& unit, double raw) {
  const double value = actuator.direction * raw;
  if (unit == "counts" || unit == "qc") {
    const double counts_per_rad = actuator.encoder_counts_per_turn * actuator.gear_ratio / kTurn_rad;
    return {{value / counts_per_rad + (is_absolute_position(object) ? actuator.offset_rad : 0.0), "rad"}};
  }
  if (unit == "counts/s" || unit == "qc/s") {
    return {{value * kTurn_rad / (actuator.encoder_counts_per_turn * actuator.gear_ratio), "rad/s"}};
  }
  if (unit == "rpm") return {{value * kTurn_rad / 60.0 / actuator.gear_ratio, "rad/s"}};
  if (unit == "mA") return current(actuator, 1e-3 * value);
  if (unit == "per mille of rated current") return current(actuator, 1e-3 * value * actuator.rated_current_A);
  if (unit == "per mille of rated torque")
    return current(actuator, 1e-3 * value * rated_torque_Nm(actuator) / actuator.torque_constant_Nm_A);
  return {};
}

}  // namespace sprung::cantools
