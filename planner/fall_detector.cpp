#include "planner/fall_detector.h"

#include <cmath>

#include "planner/gait/body_frame.h"

namespace sprung {

bool FallDetector::tilted(const EstimatedBody& body) const noexcept {
  const Attitude now = attitude(body.estimated_quaternion_wxyz);
  return std::abs(now.roll_rad) > tilt_rad_ || std::abs(now.pitch_rad) > tilt_rad_;  // false for NaN
}

bool FallDetector::fell(const EstimatedBody& body) const noexcept {
  return has_body_ && (tilted(body) || body.estimated_height_m < height_m_);
}

const char* FallDetector::why_not_up(const EstimatedBody& body) const noexcept {
  return has_body_ && body.uses_imu && tilted(body) ? "lying on its side or back: turn it over" : nullptr;
}

}  // namespace sprung
