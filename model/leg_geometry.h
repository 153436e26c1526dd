#pragma once
/// What the kinematics of all legs share.
#include <cmath>
#include <stdexcept>
#include <string>

#include "model/leg_kinematics.h"

namespace sprung {

/// @throws std::invalid_argument "leg 'NAME': KINEMATICS needs WHAT" unless ok.
inline void require_of_leg(bool ok, const LegConfig& leg, const char* kinematics, const char* what) {
  if (!ok) throw std::invalid_argument("leg '" + leg.name + "': " + kinematics + " needs " + what);
}

/// The same direction, at most half a turn from near_rad.
inline double turned_toward(double angle_rad, double near_rad) noexcept {
  constexpr double kTurn_rad = 6.283185307179586;
  return angle_rad + kTurn_rad * std::round((near_rad - angle_rad) / kTurn_rad);
}

inline SineCosine sine_cosine(double angle_rad) noexcept {
  return {std::sin(angle_rad), std::cos(angle_rad)};
}

template <class... Values>
JointVector joint_vector(Values... values) noexcept {
  JointVector v(static_cast<Eigen::Index>(sizeof...(values)));
  int joint = 0;
  ((v[joint++] = values), ...);
  return v;
}

}  // namespace sprung
