#include "planner/gait/riser_reflex.h"

#include <algorithm>

namespace sprung {
namespace {

/// [design choice] Behind its way along the ground: a free foot was seen to lag by 10 mm. In a swing that
/// goes higher, and so quicker, that much more.
constexpr double kHeldUp_m = 0.02, kQuickly_m = 0.01;
constexpr double kHeldUpFor_s = 0.01;
constexpr double kOnEdge_m = 0.012;     // [design choice] so far behind, what it touches is no ground
constexpr double kLeastSwing_m = 0.03;  // of a swing that can be held up
/// [design choice] Over where it was held up: a ball, and what is left of a stair. No higher over the
/// expected ground than this share of the hips' height: knees fold no further.
constexpr double kOver_m = 0.07, kHighest = 0.4;
/// [design choice] Beyond what held it up: on its own stair, and not on the edge; but no further than else by
/// kMostFurther_m: a leg that reaches far ahead does not reach far down.
constexpr double kTread_m = 0.12, kMostFurther_m = 0.1;
constexpr double kBackOff_m = 0.03;
constexpr int kMostTries = 3;

}  // namespace

/// By how far it stays behind: that shows before its force is believed, and wherever on its way.
bool RiserReflex::step(const Eigen::Vector2d& way_m, const Eigen::Vector3d& wanted_m,
                       const Eigen::Vector3d& foot_m, double dt_s) noexcept {
  on_edge_ = false;
  const double length_m = way_m.norm();
  if (tries_ >= kMostTries || !(length_m > kLeastSwing_m)) return false;
  const double behind_m = (wanted_m - foot_m).head<2>().dot(way_m) / length_m;
  const double quickly_m = goes_over() ? kQuickly_m : 0.0;
  on_edge_ = behind_m > kOnEdge_m + quickly_m;
  lags_s_ = behind_m > kHeldUp_m + quickly_m ? lags_s_ + dt_s : 0.0;
  if (lags_s_ < kHeldUpFor_s) return false;
  on_edge_ = false;
  lags_s_ = 0.0;
  ++tries_;
  held_m_ = foot_m;
  ahead_ = way_m / length_m;
  return true;
}

Eigen::Vector3d RiserReflex::foothold_m(const Eigen::Vector3d& foothold_m) const noexcept {
  if (tries_ == 0) return foothold_m;
  Eigen::Vector3d out = foothold_m;
  const double beyond_m = (foothold_m - held_m_).head<2>().dot(ahead_);
  out.head<2>() += std::clamp(kTread_m - beyond_m, 0.0, kMostFurther_m) * ahead_;
  return out;
}

double RiserReflex::top_m(double ground_z_m) const noexcept {
  return std::min(held_m_.z() + kOver_m, (1.0 - kHighest) * ground_z_m);
}

Eigen::Vector2d RiserReflex::aside_m() const noexcept {
  return tries_ > 0 ? Eigen::Vector2d(-kBackOff_m * ahead_) : Eigen::Vector2d::Zero();
}

}  // namespace sprung
