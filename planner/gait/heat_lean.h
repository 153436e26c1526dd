#pragma once
/// Where the body of a robot that walks goes so that its warmest leg carries less: legs that step the same
/// are not as warm where friction, lengths or a load on the back differ, and the warmest one slows the whole
/// walk (motor_heat.h). Pure.
#include <Eigen/Core>

#include "planner/gait/body_view.h"
#include "signals/joint_state.h"

namespace sprung {

class HeatLean {
 public:
  void reset() noexcept { at_m_.setZero(); }
  /// One cycle. @param leads false: back over the middle of the feet, e.g. to stand.
  void step(const JointState& in, const BodyShape& shape, bool leads, double dt_s) noexcept;

  /// Of the body from the middle of its feet's places, forward and left, level axes.
  const Eigen::Vector2d& at_m() const noexcept { return at_m_; }

  // [design choice] A winding follows its current in a minute; 20 mm of pegasus' 0.66 m between its hips are
  // 6 % of a leg's load and 12 % of its heat.
  static constexpr double kFrom = 0.4;   ///< winding_share from which a leg counts,
  static constexpr double kFully = 0.8;  ///< and counts fully: there the walk slows down
  static constexpr double kMost_m = 0.02;

 private:
  Eigen::Vector2d at_m_ = Eigen::Vector2d::Zero();
};

}  // namespace sprung
