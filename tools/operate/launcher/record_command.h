#pragma once
/// Which recording tells a joint's model anew.
#include <string>

#include "robots/robot_config.h"

namespace sprung {

/// The command that records a joint again; the robot hangs.
std::string record_command(const RobotConfig& robot, const JointConfig& joint);

/// What to repeat for the joints that a note names (misfit_note.h): the first one's command, and that the
/// others are recorded alike. Empty: the note names none.
std::string recordings_to_repeat(const RobotConfig& robot, const std::string& note);

}  // namespace sprung
