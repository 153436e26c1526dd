#pragma once
/// A weight somewhere on the back that nobody told the robot of. Pure.
#include <map>
#include <string>

#include "robots/robot_config.h"
#include "tools/lab/run/dice.h"

namespace sprung {

/// Keys of `--plant`: anywhere between the hips, and as high as a box of 0.15 m on a trunk like pegasus'.
std::map<std::string, double> drawn_payload(const RobotConfig& robot, double mass_kg, Dice& dice);

}  // namespace sprung
