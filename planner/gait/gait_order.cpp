#include "planner/gait/gait_order.h"

#include <cmath>

namespace sprung {
namespace {

/// On the same side, and as far behind as this one is ahead.
std::size_t mirrored_leg(const BodyShape& shape, std::size_t leg) noexcept {
  const Eigen::Vector3d& hip_m = shape.hip_in_trunk_m[leg];
  std::size_t nearest = leg;
  double least_m = INFINITY;
  for (std::size_t i = 0; i < shape.legs; ++i) {
    const double off_m = (shape.hip_in_trunk_m[i] - Eigen::Vector3d(-hip_m.x(), hip_m.y(), hip_m.z())).norm();
    if (off_m >= least_m) continue;
    least_m = off_m;
    nearest = i;
  }
  return nearest;
}

}  // namespace

GaitConfig backward_order(const GaitConfig& gait, const BodyShape& shape) {
  GaitConfig out = gait;
  bool same = true;
  for (std::size_t i = 0; i < shape.legs; ++i) {
    out.offsets[i] = gait.offsets[mirrored_leg(shape, i)];
    const double later = out.offsets[i] - gait.offsets[i] - (out.offsets[0] - gait.offsets[0]);
    same = same && std::abs(std::remainder(later, 1.0)) < 1e-9;
  }
  return same ? gait : out;
}

}  // namespace sprung
