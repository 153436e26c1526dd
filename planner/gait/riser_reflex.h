#pragma once
/// A foot that is held up on its way along the ground, by a stair or a kerb. Blind: it is felt. Its swing
/// begins anew from where it is: back a little, over what holds it up, and beyond that by so much that it
/// does not come down on an edge. Level axes. Pure.
#include <Eigen/Core>

namespace sprung {

class RiserReflex {
 public:
  /// One cycle of a swing. @param way_m along the ground, from where it left to its foothold. @param wanted_m
  /// and foot_m of the foot, measured. @return true in the cycle in which it is found to be held up.
  bool step(const Eigen::Vector2d& way_m, const Eigen::Vector3d& wanted_m, const Eigen::Vector3d& foot_m,
            double dt_s) noexcept;
  /// One cycle. @param ground_m_s as the body sees it.
  void carry(const Eigen::Vector3d& ground_m_s, double dt_s) noexcept { held_m_ += ground_m_s * dt_s; }
  /// As the body sees the ground, whose trunk has sunk toward it.
  void sink(double by_m) noexcept { held_m_.z() += by_m; }
  const Eigen::Vector3d& held_m() const noexcept { return held_m_; }
  /// A swing begins.
  void forget() noexcept { *this = RiserReflex(); }

  /// What it may touch now holds it up, and is no ground to stand on.
  bool on_edge() const noexcept { return on_edge_; }
  /// It was held up in this swing, and goes over that.
  bool goes_over() const noexcept { return tries_ > 0; }
  /// Where that swing is to end. @param foothold_m where it would else.
  Eigen::Vector3d foothold_m(const Eigen::Vector3d& foothold_m) const noexcept;
  /// How high it is to go. @param ground_z_m expected, from the middle of the hips.
  double top_m(double ground_z_m) const noexcept;
  /// How far aside of its way, back from the riser, while it rises.
  Eigen::Vector2d aside_m() const noexcept;

 private:
  int tries_ = 0;  ///< how often it was held up in this swing
  bool on_edge_ = false;
  double lags_s_ = 0.0;
  Eigen::Vector3d held_m_ = Eigen::Vector3d::Zero();  ///< where it was, carried along with the ground
  Eigen::Vector2d ahead_ = Eigen::Vector2d::Zero();   ///< its way, when it was held up; unit
};

}  // namespace sprung
