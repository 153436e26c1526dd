#pragma once
/// `sprung experiment endurance`: what an operator at random asks of a walking robot, and the plants it is
/// asked of. Pure; the same seed gives the same.
#include <cstdint>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "signals/operator.h"
#include "simulation/sim_core.h"

namespace sprung {

/// One request, and how long it stands.
struct EnduranceStep {
  OperatorCommand command;  ///< kWalk or kStop
  double lasts_s = 0.0;
};

/// Requests of 3 to 12 s each, `duration_s` in all: gaits that may follow each other, speeds and turning over
/// all that a gait allows, body heights and stance widths; one in eight stops. Every one is allowed where it
/// stands.
/// @param duration_s at least 0.
std::vector<EnduranceStep> endurance_script(const RobotConfig& robot, const std::string& preset,
                                            std::uint64_t seed, double duration_s);

/// Noise of this seed; friction within 20 %, mass within 10 %, floor friction of 0.4 to 1.0, drawn evenly.
SimOptions endurance_plant(std::uint64_t seed);

}  // namespace sprung
