#include "planner/gait/support_triangle.h"

#include <algorithm>
#include <limits>

namespace sprung {
namespace {

constexpr double kLeastSide_m = 1e-3;  // two feet on one spot make no side

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) noexcept {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

SupportTriangle::SupportTriangle(const std::array<Eigen::Vector2d, 3>& feet_m) noexcept : feet_m_(feet_m) {
  const double twice_area_m2 = cross(feet_m[1] - feet_m[0], feet_m[2] - feet_m[0]);
  const double turn = twice_area_m2 >= 0.0 ? 1.0 : -1.0;
  double around_m = 0.0;
  Eigen::Vector2d weighed_m2 = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    const Eigen::Vector2d side_m = feet_m[(i + 1) % 3] - feet_m[i];
    const double length_m = std::max(kLeastSide_m, side_m.norm());
    inward_[i] = turn * Eigen::Vector2d(-side_m.y(), side_m.x()) / length_m;
    around_m += length_m;
    weighed_m2 += length_m * feet_m[(i + 2) % 3];  // a corner counts as its opposite side is long
  }
  middle_m_ = weighed_m2 / around_m;
  inradius_m_ = turn * twice_area_m2 / around_m;
}

double SupportTriangle::distance_m(std::size_t side, const Eigen::Vector2d& place_m) const noexcept {
  return inward_[side].dot(place_m - feet_m_[side]);
}

double SupportTriangle::margin_m(const Eigen::Vector2d& place_m) const noexcept {
  return std::min({distance_m(0, place_m), distance_m(1, place_m), distance_m(2, place_m)});
}

Eigen::Vector2d SupportTriangle::safe_place_m(const Eigen::Vector2d& from_m, double margin_m) const noexcept {
  if (margin_m >= inradius_m_) return middle_m_;
  /// Of the way; along it each distance grows or shrinks in a straight line to the inradius.
  double share = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double here_m = distance_m(i, from_m);
    if (here_m < margin_m) share = std::max(share, (margin_m - here_m) / (inradius_m_ - here_m));
  }
  return from_m + share * (middle_m_ - from_m);
}

}  // namespace sprung
