#pragma once
/// DRIVE_STATEs of an LCM log. Reads files.
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "signals/drive_state.h"

namespace sprung::identify {

struct DriveLog {
  std::vector<DriveState> states;
  std::vector<std::string> notes;  ///< messages that were left out
};

/// Of the first session that the log holds.
/// @throws std::runtime_error when the file is no LCM log or holds no DRIVE_STATE of this robot.
DriveLog read_drive_log(const std::string& path, const RobotConfig& robot);

/// Robot that the log names itself; "" where it does not. @throws as above.
std::string robot_of_log(const std::string& path);

}  // namespace sprung::identify
