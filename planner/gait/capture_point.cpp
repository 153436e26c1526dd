#include "planner/gait/capture_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/leg_kinematics.h"

namespace sprung {
namespace {

double turn_m2(const Eigen::Vector2d& a, const Eigen::Vector2d& b) noexcept {
  return a.x() * b.y() - a.y() * b.x();
}

/// All feet are on the left of the line from one to another.
bool is_side(const BodyView& view, std::size_t legs, std::size_t from, std::size_t to) noexcept {
  const Eigen::Vector2d along_m = (view.foot_m[to] - view.foot_m[from]).head<2>();
  for (std::size_t i = 0; i < legs; ++i)
    if (turn_m2(along_m, (view.foot_m[i] - view.foot_m[from]).head<2>()) < 0.0) return false;
  return true;
}

}  // namespace

double capture_s(const BodyView& view, std::size_t legs) noexcept {
  double lowest_m = 0.0;
  for (std::size_t i = 0; i < legs; ++i) lowest_m = std::min(lowest_m, view.foot_m[i].z() - view.com_m.z());
  return std::sqrt(-lowest_m / kGravity_m_s2);
}

double beyond_feet_m(const BodyView& view, std::size_t legs) noexcept {
  for (std::size_t i = 0; i < legs; ++i)
    if (!view.foot_m[i].allFinite()) return kNaN;
  const Eigen::Vector2d point_m = (view.com_m + capture_s(view, legs) * view.velocity_m_s).head<2>();
  double beyond_m = -std::numeric_limits<double>::infinity();
  int sides = 0;
  for (std::size_t from = 0; from < legs; ++from) {
    for (std::size_t to = 0; to < legs; ++to) {
      const Eigen::Vector2d along_m = (view.foot_m[to] - view.foot_m[from]).head<2>();
      constexpr double kApart_m = 0.01;
      if (from == to || along_m.norm() < kApart_m || !is_side(view, legs, from, to)) continue;
      beyond_m = std::max(beyond_m,
                          -turn_m2(along_m, point_m - view.foot_m[from].head<2>()) / along_m.norm());
      ++sides;
    }
  }
  return sides >= 3 ? beyond_m : kNaN;
}

double capture_beyond(const JointState& in, const BodyShape& shape) noexcept {
  const BodyView view = BodyView::of(in, shape);
  return view.velocity_known ? beyond_feet_m(view, shape.legs) / in.body.estimated_height_m : kNaN;
}

}  // namespace sprung
