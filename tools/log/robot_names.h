#pragma once
/// Names of a robot's joints, legs and actuators, for fields that have only numbers. Shell: reads robots/.
#include <string>
#include <vector>

#include "tools/fields/field_choice.h"

namespace sprung::log {

struct RobotNames {
  std::vector<std::string> legs;
  std::vector<fields::ListNames> lists;  ///< "joints", "legs", "actuators" of the messages
};

/// Empty where there is no such robot here: a log is read on any machine.
RobotNames names_of_robot(const std::string& robot);

}  // namespace sprung::log
