#pragma once
/// Simulated drives before and after commissioning. Pure; allocates.
#include "robots/robot_config.h"
#include "simulation/node/motor_wiring.h"

namespace sprung::commission {

/// Set up for its motor as the make's plan wants it, and wired right.
sim::DriveWiring commissioned_drive(const ActuatorConfig& machine);
/// Wired right, but with everything as its maker sells it (the defaults of the EDS); only its node id is set.
sim::DriveWiring factory_drive(const ActuatorConfig& machine);

}  // namespace sprung::commission
