#pragma once
/// A leg of pegasus as facts C6 describe it, and one whose thigh is shorter than its shank, so that near its
/// hip is a hole.
#include "robots/robot_config.h"

namespace sprung::test {

inline LegConfig pegasus_leg(LegSide side) {
  LegConfig leg;
  leg.name = side == LegSide::kLeft ? "fl" : "fr";
  leg.kinematics = kThreeJoint;
  leg.side = side;
  leg.joints = {0, 1, 2};
  leg.actuators = {0, 1, 2};
  leg.transmission = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  leg.links = {{0.08, 3.3, 0.04, 0.0079}, {0.30, 0.8, 0.13, 0.0060}, {0.30, 0.4, 0.13, 0.0030}};
  return leg;
}

inline LegConfig uneven_leg(LegSide side) {
  LegConfig leg = pegasus_leg(side);
  leg.links[1].length_m = 0.25;
  leg.links[2].length_m = 0.35;
  return leg;
}

}  // namespace sprung::test
