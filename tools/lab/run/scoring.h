#pragma once
/// What plants and scorers of experiments share. Pure.
#include <cstddef>
#include <random>
#include <string>

#include "robots/robot_config.h"

namespace sprung {

/// Index of a joint that an experiment measures. @throws std::invalid_argument where the robot has none of
/// this name.
std::size_t measured_joint(const RobotConfig& robot, const std::string& name);

/// Follows the largest absolute value; a peak of NaN is none yet, and a value of NaN is none. @return true
/// when it is a new peak.
bool raise_peak(double& peak, double value) noexcept;

/// In [-1, 1), the same on every machine, which std::uniform_real_distribution does not promise.
inline double even(std::mt19937_64& random) {
  return 2.0 * static_cast<double>(random() >> 11) * 0x1p-53 - 1.0;
}

}  // namespace sprung
