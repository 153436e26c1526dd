#pragma once
/// What is hung at a foot so that a recording shows friction under load and the torque constant
/// (docs/estimation.md "A known weight"). Pure; start-up only.
#include "robots/robot_config.h"

namespace sprung {

/// One that loads the joint with a fifth of what its actuator gives at most: well beyond friction, and it
/// leaves enough for the swings. In half kilograms, as weights are to be had; half a kilogram at least,
/// whatever the actuator. 0: the joint turns no link that could bear it.
double known_weight_kg(const RobotConfig& robot, int joint);

}  // namespace sprung
