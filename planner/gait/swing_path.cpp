#include "planner/gait/swing_path.h"

#include <algorithm>

namespace sprung {
namespace {

struct Point {
  double value;
  double rate;
  double rate2;  ///< second derivative
};

/// Least jerk (Flash and Hogan 1985): from 0 to 1, at rest at both ends.
Point smooth(double u) noexcept {
  return {u * u * u * (10.0 - 15.0 * u + 6.0 * u * u), 30.0 * u * u * (1.0 - u) * (1.0 - u),
          60.0 * u * (1.0 - u) * (1.0 - 2.0 * u)};
}

/// From 0 to 1 at a third of the time and back, at rest at both ends.
Point detour(double u) noexcept {
  constexpr double kScale = 729.0 / 16.0;
  const double v = 1.0 - u;
  return {kScale * u * u * v * v * v * v, kScale * 2.0 * u * v * v * v * (1.0 - 3.0 * u),
          kScale * 2.0 * v * v * (1.0 - 10.0 * u + 15.0 * u * u)};
}

/// Cubic with the value and the rate that are given at each end of its duration.
struct Cubic {
  double from, from_rate, to, to_rate, duration;

  Point at(double t) const noexcept {
    const double slope = (to - from) / duration;
    const double c2 = (3.0 * slope - 2.0 * from_rate - to_rate) / duration;
    const double c3 = (from_rate + to_rate - 2.0 * slope) / (duration * duration);
    return {from + t * (from_rate + t * (c2 + t * c3)), from_rate + t * (2.0 * c2 + 3.0 * t * c3),
            2.0 * c2 + 6.0 * t * c3};
  }
};

/// Up from rest, over a place half way and down to `to` at to_rate: of all such ways the one whose squared
/// acceleration, and with it the heat of motors that move little else than their own rotors, is least (a
/// cubic spline).
Point arc(double from, double over, double to, double to_rate, double duration, double t) noexcept {
  const double half = 0.5 * duration;
  const double over_rate = (3.0 * (to - from) / half - to_rate) / 4.0;  // no step of acceleration there
  if (t < half) return Cubic{from, 0.0, over, over_rate, half}.at(t);
  return Cubic{over, over_rate, to, to_rate, half}.at(t - half);
}

/// Against ground that sinks under a body that climbs.
Point height(const SwingPath& path, double time_s) noexcept {
  const double high_s = path.duration_s - path.approach_s;
  const double over_m = path.approach_m_s *
                        path.approach_s;  // above the ground where the straight way down begins
  const double ends_m = path.to_m.z() - path.ground_m_s.z() * path.duration_s;
  const double to_m = ends_m + over_m;
  const double approach_m_s = path.approach_s > 0.0 ? path.approach_m_s : 0.0;
  if (time_s >= high_s) return {to_m - approach_m_s * (time_s - high_s), -approach_m_s, 0.0};
  const double top_m = 0.5 * (path.from_m.z() + ends_m) + path.lift_m;
  return arc(path.from_m.z(), top_m, to_m, -approach_m_s, high_s, std::max(0.0, time_s));
}

}  // namespace

SwingPoint SwingPath::at(double time_s) const noexcept {
  const double t = std::clamp(time_s, 0.0, duration_s);
  SwingPoint out;
  // Against the ground the foot is at rest at both ends; the body sees the ground move.
  const double way_s = duration_s - approach_s;
  const Point way = smooth(std::min(1.0, t / way_s));
  const Eigen::Vector3d over_ground_m = to_m - from_m - ground_m_s * duration_s;
  out.position_m = from_m + over_ground_m * way.value + ground_m_s * t;
  out.velocity_m_s = over_ground_m * (way.rate / way_s) + ground_m_s;
  out.acceleration_m_s2 = over_ground_m * (way.rate2 / (way_s * way_s));

  const Point off = detour(std::min(1.0, t / way_s));
  out.position_m.head<2>() += aside_m * off.value;
  out.velocity_m_s.head<2>() += aside_m * (off.rate / way_s);
  out.acceleration_m_s2.head<2>() += aside_m * (off.rate2 / (way_s * way_s));

  const Point z = height(*this, time_s);
  out.position_m.z() = z.value + ground_m_s.z() * t;
  out.velocity_m_s.z() = z.rate + ground_m_s.z();
  out.acceleration_m_s2.z() = z.rate2;
  if (time_s > duration_s) {
    out.position_m += ground_m_s * (time_s - duration_s);
    out.acceleration_m_s2.setZero();
  }
  return out;
}

}  // namespace sprung
