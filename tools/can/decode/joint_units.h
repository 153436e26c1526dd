#pragma once
/// Raw values of a drive's objects in joint units (rad, rad/s, A, Nm at the gear's output side), by the unit
/// that its EDS gives and the actuator's numbers in robot.yaml. Pure.
#include <cstdint>
#include <string>
#include <vector>

#include "drivers/canopen/wire.h"
#include "robots/robot_config.h"

namespace sprung::cantools {

struct JointValue {
  double value = 0.0;
  const char* unit = "";  ///< static text
};

/// Empty where the unit has no counterpart at the joint. A current or a torque gives both: A of the motor,
/// and Nm at the gear's output before friction and rotor inertia. Signs are the actuator's (robot.yaml
/// `direction`); its offset is added to absolute positions only.
std::vector<JointValue> in_joint_units(const ActuatorConfig& actuator, canopen::ObjectId object,
                                       const std::string& unit, double raw);

}  // namespace sprung::cantools
