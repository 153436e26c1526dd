#include "planner/gait/heat_lean.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

constexpr double kThere_m_s = 0.005;  // [design choice] the gait does not notice
constexpr double kBack_m_s = 0.1;     // within the swings that set the feet in their places

/// How much a leg counts, 0 to 1, by its warmest motor; one of which nothing is known is cold.
double weight(const JointState& in, const std::vector<int>& joints) noexcept {
  double warmth = 0.0;
  for (const int joint : joints)
    warmth = std::fmax(warmth, in.joints[static_cast<std::size_t>(joint)].winding_share);
  return std::clamp((warmth - HeatLean::kFrom) / (HeatLean::kFully - HeatLean::kFrom), 0.0, 1.0);
}

Eigen::Vector2d place_m(const BodyShape& shape, std::size_t leg) noexcept {
  return (shape.hip_in_trunk_m[leg] + shape.foot_beside_hip_m[leg]).head<2>();
}

/// A trunk's origin need not be there.
Eigen::Vector2d middle_m(const BodyShape& shape) noexcept {
  Eigen::Vector2d sum_m = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < shape.legs; ++i) sum_m += place_m(shape, i);
  return sum_m / static_cast<double>(shape.legs);
}

}  // namespace

void HeatLean::step(const JointState& in, const BodyShape& shape, bool leads, double dt_s) noexcept {
  const Eigen::Vector2d middle = middle_m(shape);
  Eigen::Vector2d wanted_m = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; leads && i < shape.legs; ++i) {
    const Eigen::Vector2d outward = (place_m(shape, i) - middle).normalized();
    wanted_m -= kMost_m * weight(in, shape.joints[i]) * outward;
  }
  if (wanted_m.norm() > kMost_m) wanted_m *= kMost_m / wanted_m.norm();
  const Eigen::Vector2d way_m = wanted_m - at_m_;
  const double most_m = (leads ? kThere_m_s : kBack_m_s) * dt_s;
  at_m_ += way_m.norm() > most_m ? Eigen::Vector2d(way_m * (most_m / way_m.norm())) : way_m;
}

}  // namespace sprung
