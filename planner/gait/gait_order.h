#pragma once
/// In which order the legs of a gait follow each other, for where the robot goes. Pure.
#include "planner/gait/body_view.h"
#include "robots/gait_config.h"

namespace sprung {

/// A gait, and whether its legs follow each other for walking backward.
struct GaitOrder {
  int gait = -1;  ///< index into RobotConfig::gaits
  bool backward = false;
  bool operator==(const GaitOrder& o) const noexcept { return gait == o.gait && backward == o.backward; }
};

/// Front and hind legs change places, so that what keeps a robot from tipping forward keeps it from tipping
/// backward. Another phase of the same gait is no other order: a trot is its own mirror image, and itself is
/// returned. @param gait one offset for each leg of `shape`.
GaitConfig backward_order(const GaitConfig& gait, const BodyShape& shape);

}  // namespace sprung
