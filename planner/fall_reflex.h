#pragma once
/// A fall that no step catches, met: before the trunk is down all legs fold, so that it tips no further, go
/// to where the capture point is going to be, and take the impact as springs. Damped legs hold a tipping
/// robot up like struts, over which it topples with all of its height. Pure: no heap.
#include <Eigen/Core>
#include <array>

#include "planner/gait/body_view.h"
#include "signals/leg_command.h"

namespace sprung {

class FallReflex {
 public:
  explicit FallReflex(const RobotConfig& robot) : shape_(robot) {}

  /// Now, from where the feet are. @param folded_m of a leg that is folded, of one that is nearly straight.
  void begin(const JointState& in, double folded_m, double straight_m) noexcept;
  void end() noexcept { active_ = false; }
  /// Once a cycle.
  void step(const JointState& in) noexcept;
  bool acts() const noexcept { return active_; }
  void write(std::size_t leg, DesiredLeg& out) const noexcept;

  static constexpr double kLasts_s = 0.9;

 private:
  BodyShape shape_;
  bool active_ = false;
  std::int64_t began_us_ = 0;
  double since_s_ = 0.0;
  double folded_m_ = 0.0;
  double farthest_m_ = 0.0;                          ///< that a foot goes from beside its hip
  std::array<Eigen::Vector3d, kMostLegs> from_m_{};  ///< feet when it began: from their hips, level axes
  Eigen::Matrix3d level_from_trunk_ = Eigen::Matrix3d::Identity();
  Eigen::Vector2d speed_m_s_ = Eigen::Vector2d::Zero();  ///< as long as it was known; level axes
};

}  // namespace sprung
