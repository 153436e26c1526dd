#pragma once
/// The robot of a log, and names of its joints, legs and actuators for fields that have only numbers. Shell:
/// reads the log and robots/.
#include <optional>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "tools/logs/fields/field_choice.h"
#include "tools/logs/log/reader.h"

namespace sprung::log {

struct LoggedRobot {
  std::optional<RobotConfig> robot;
  std::string missing;  ///< why it is not known; "" where it is
};

/// From the robot.yaml that stands in the log. Another program's log has none: then from robots/, where that
/// file has the hash that the log's processes say, and from nowhere else: joints of another robot.yaml may
/// have the same numbers. Leaves the reader at its begin.
LoggedRobot robot_in_log(Reader& reader);

struct RobotNames {
  std::vector<std::string> legs;
  std::vector<fields::ListNames> lists;  ///< "joints", "legs", "actuators" of the messages
  std::string missing;  ///< why there are none, and what follows from that; "" where there are
};

RobotNames names_of_robot(const RobotConfig& robot);
/// Leaves the reader at its begin.
RobotNames names_in_log(Reader& reader);

}  // namespace sprung::log
