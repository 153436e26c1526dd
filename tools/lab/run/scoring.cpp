#include "tools/lab/run/scoring.h"

#include <cmath>
#include <stdexcept>

namespace sprung {

std::size_t measured_joint(const RobotConfig& robot, const std::string& name) {
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    if (robot.joints[i].name == name) return i;
  }
  throw std::invalid_argument("robot " + robot.name + " has no joint '" + name +
                              "', which this experiment measures");
}

bool raise_peak(double& peak, double value) noexcept {
  const double size = std::abs(value);
  const bool higher = std::isnan(peak) ? !std::isnan(size) : size > peak;
  if (higher) peak = size;
  return higher;
}

}  // namespace sprung
