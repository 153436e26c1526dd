#pragma once
/// How the body is to be held over its feet: wrench on it from height, attitude and speed, and how far it
/// leans before a leg is lifted. Level axes. Pure. docs/locomotion.md.
#include "planner/gait/body_view.h"
#include "planner/gait/force_distribution.h"

namespace sprung {

struct BodyWish {
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
  double turning_rad_s = 0.0;
  Attitude attitude;      ///< heading is not read
  double height_m = 0.0;  ///< of the hips over the feet
  double height_now_m = 0.0;
};

/// Weight included, about the centre of mass.
BodyWrench wanted_wrench(const WalkConfig& law, const BodyShape& shape, const BodyView& view,
                         const BodyWish& wish) noexcept;

/// Follows a wanted lean through three equal poles: neither place, speed nor acceleration jumps. (With two
/// the body began with twice the acceleration, and what is over one foot's line then tips the wrong way.)
class Lean {
 public:
  void rest_at(const Eigen::Vector2d& at_m) noexcept {
    at_m_ = at_m;
    speed_m_s_.setZero();
    acceleration_m_s2_.setZero();
  }
  /// @param settle_s in which nine tenths of the way are done.
  void follow(const Eigen::Vector2d& wanted_m, double settle_s, double dt_s) noexcept;
  const Eigen::Vector2d& at_m() const noexcept { return at_m_; }
  const Eigen::Vector2d& speed_m_s() const noexcept { return speed_m_s_; }

 private:
  Eigen::Vector2d at_m_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d speed_m_s_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d acceleration_m_s2_ = Eigen::Vector2d::Zero();
};

}  // namespace sprung
