#pragma once
/// What scorers of experiments share. Pure.
#include <cstddef>
#include <string>

#include "robots/robot_config.h"

namespace sprung {

/// Index of a joint that an experiment measures. @throws std::invalid_argument where the robot has none of
/// this name.
std::size_t measured_joint(const RobotConfig& robot, const std::string& name);

/// Follows the largest absolute value; a peak of NaN is none yet, and a value of NaN is none. @return true
/// when it is a new peak.
bool raise_peak(double& peak, double value) noexcept;

}  // namespace sprung
