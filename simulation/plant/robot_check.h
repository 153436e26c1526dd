#pragma once
/// Holds what robot.yaml believes of a robot against model.xml and sim.yaml, which say what it is: a mistake
/// in one of them else shows as a robot that stands, accepts a walk and falls. For `sprung robot check` and
/// `sprung up`; no process of the stack calls it.
#include <string>
#include <vector>

#include "robots/robot_config.h"

namespace sprung::sim {

enum class CheckAgainst {
  kModel,        ///< model.xml alone: on real buses
  kModelAndSim,  ///< and sim.yaml: with simulated drives
};

/// How far the two may be apart: what people weigh and measure, not what `sprung identify` finds.
struct CheckTolerance {
  double length_m = 0.005;
  double angle_rad = 0.05;
  double mass_share = 0.2;  ///< of the larger, beyond mass_kg
  double mass_kg = 0.05;
  double com_m = 0.03;
  double constant_share = 0.25;  ///< torque constants
  double inertia_share = 0.5;    ///< links' inertia, armature
};

/// Is there a model.xml to hold it against?
bool has_model(const RobotConfig& robot);

/// @return one sentence for each thing that differs, with both values and where each was typed; none: all
/// agree.
/// @throws ConfigError where a file cannot be read at all.
std::vector<std::string> check_robot(const RobotConfig& robot, CheckAgainst against,
                                     const CheckTolerance& tolerance = {});

}  // namespace sprung::sim
