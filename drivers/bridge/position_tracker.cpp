#include "drivers/bridge/position_tracker.h"

#include <cmath>

namespace sprung {
namespace {

constexpr double kTimeConstant_s =
    0.004;  // [design choice] 40 Hz: far above the pole of damping / armature, 20 rad/s
constexpr double kSpeedFactor = 3.0;  // [design choice] over speed_limit
constexpr double kSlack_rad = 0.3;    // [design choice] for one sampling instant that was off

}  // namespace

bool PositionTracker::add(double measured_position_rad, std::int64_t time_us) noexcept {
  const double step_rad = measured_position_rad - last_position_rad_;
  const double dt_s = 1e-6 * static_cast<double>(time_us - last_us_);
  const bool first = !known_;
  last_position_rad_ = measured_position_rad;
  last_us_ = time_us;
  known_ = true;
  if (first || !(dt_s > 0.0)) {
    velocity_rad_s_ = 0.0;
    return true;
  }
  // A step that cannot be is no motion to damp.
  if (!(std::abs(step_rad) <= kSpeedFactor * speed_limit_rad_s_ * dt_s + kSlack_rad)) return false;
  velocity_rad_s_ += (step_rad / dt_s - velocity_rad_s_) * dt_s / (kTimeConstant_s + dt_s);
  return true;
}

}  // namespace sprung
