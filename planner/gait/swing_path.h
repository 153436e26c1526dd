#pragma once
/// Way of a swinging foot, in level axes that go with the body (x along the heading, z up, origin in the
/// middle of the hips). It leaves and meets the ground with the ground's own velocity. Pure.
#include <Eigen/Core>

namespace sprung {

struct SwingPoint {
  Eigen::Vector3d position_m;
  Eigen::Vector3d velocity_m_s;
  Eigen::Vector3d acceleration_m_s2;
};

struct SwingPath {
  Eigen::Vector3d from_m;
  Eigen::Vector3d to_m;        ///< expected ground; may move a little from cycle to cycle
  Eigen::Vector3d ground_m_s;  ///< of the ground as the body sees it: minus the body's speed
  double duration_s = 0.0;
  double lift_m = 0.0;
  double approach_s = 0.0;  ///< at the end: straight down at approach_m_s; 0: none
  double approach_m_s = 0.0;
  /// That far off its way along the ground at a third of it, while it rises: away from what held it up.
  Eigen::Vector2d aside_m = Eigen::Vector2d::Zero();

  /// @param time_s since the foot left; beyond duration_s it goes on down at the approach speed, or rests on
  /// the ground.
  SwingPoint at(double time_s) const noexcept;
};

}  // namespace sprung
