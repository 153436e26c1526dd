#include "planner/gait/swing_path.h"

#include <algorithm>

namespace sprung {
namespace {

struct Share {
  double value;
  double rate;  ///< d value / d u
};

/// Least jerk (Flash and Hogan 1985): at rest at both ends.
Share smooth(double u) noexcept {
  return {u * u * u * (10.0 - 15.0 * u + 6.0 * u * u), 30.0 * u * u * (1.0 - u) * (1.0 - u)};
}

/// 0, 1, 0 at u = 0, 1/2, 1, flat at each.
Share bump(double u) noexcept {
  const double side = u * (1.0 - u);
  return {16.0 * side * side, 32.0 * side * (1.0 - 2.0 * u)};
}

}  // namespace

SwingPoint SwingPath::at(double time_s) const noexcept {
  const double t = std::clamp(time_s, 0.0, duration_s);
  SwingPoint out;
  // Against the ground the foot is at rest at both ends; the body sees the ground move.
  const Share way = smooth(t / duration_s);
  const Eigen::Vector3d over_ground_m = to_m - from_m - ground_m_s * duration_s;
  out.position_m = from_m + over_ground_m * way.value + ground_m_s * t;
  out.velocity_m_s = over_ground_m * (way.rate / duration_s) + ground_m_s;

  const double high_s = duration_s - approach_s;
  const double over_m = approach_m_s * approach_s;  // above the ground where the straight way down begins
  const double u = std::min(1.0, t / high_s);
  const Share rise = smooth(u);
  const Share arc = bump(u);
  const double to_z_m = to_m.z() + over_m;
  out.position_m.z() = from_m.z() + (to_z_m - from_m.z()) * rise.value + lift_m * arc.value;
  out.velocity_m_s.z() = ((to_z_m - from_m.z()) * rise.rate + lift_m * arc.rate) / high_s;
  if (approach_s > 0.0 && time_s > high_s) {
    out.position_m.z() = to_z_m - approach_m_s * (time_s - high_s);
    out.velocity_m_s.z() = -approach_m_s;
  }
  if (time_s > duration_s)
    out.position_m += Eigen::Vector3d(ground_m_s.x(), ground_m_s.y(), 0.0) * (time_s - duration_s);
  return out;
}

}  // namespace sprung
