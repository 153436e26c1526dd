#pragma once
/// Which of a robot's gaits an operator's `walk` means, and how fast it is to go. Pure; names and speeds are
/// robot.yaml's.
#include <string>

#include "robots/robot_config.h"
#include "signals/vec3.h"

namespace sprung {

/// NaN: not said. Forward alone then is two thirds of the gait's fastest; the others are 0, and so is forward
/// beside them.
struct GaitWish {
  std::string gait;  ///< empty: not said
  double forward_m_s = kNaN;
  double left_m_s = kNaN;
  double turning_rad_s = kNaN;  ///< counter-clockwise, seen from above
};

struct GaitChoice {
  int gait = -1;  ///< index into RobotConfig::gaits
  Vec3 speed{0, 0, 0};
};

/// Without a name: the gait that it walks in, where that can go so fast; else the fastest of those that can
/// (trot before crawl).
/// @param walking_in index of the gait that it walks in; -1: it does not walk.
/// @throws std::invalid_argument where there is no such gait or none goes so fast, with the gaits there are.
GaitChoice choose_gait(const RobotConfig& robot, const GaitWish& wish, int walking_in = -1);

/// Each with its fastest speeds: "crawl 0.12 0.05 0.15, trot 0.45 0.15 0.5 (forward m/s, ...)".
std::string gaits_text(const RobotConfig& robot);

}  // namespace sprung
