#pragma once
/// A hand that takes a foot, leads it away by a distance, holds it there, and lets go slowly: its force fades
/// in a straight line. S1 (Fig. 10) does not say how its hand let go; over 1 to 3 s is what a person does
/// (facts physics 16: the protocol decides). Pure.
#include "tools/lab/leg/foot_return_score.h"

namespace sprung {

struct PullAndRelease {
  double direction_rad = 0.0;  ///< in the leg's plane, from forward toward up
  double distance_m = 0.0;
  double release_s = 1.0;
};

/// Eight directions, five distances of 8 to 40 mm each; releases of 1, 1.5, 2, 2.5 and 3 s, each as often
/// with every distance.
std::vector<PullAndRelease> pulls_and_releases();

/// One pull. It leads by a stiff spring from behind, so that the foot never goes back before the release:
/// friction then stays on the side that resists the pull.
class FootDisturbance {
 public:
  static constexpr double kReach_s = 1.0, kHold_s = 0.5;
  static constexpr double kGone_s = kReach_s + kHold_s;  ///< from then on the force fades
  static constexpr double kStiffness_N_m = 5e4, kDamping_N_s_m = 500.0;

  FootDisturbance(const PullAndRelease& pull, double step_s) noexcept : pull_(pull), step_s_(step_s) {}
  /// Once a cycle. @param time_s since the hand took the foot. @param foot_m, from where it was then. @return
  /// force on the foot, N, forward and up in the members x_m and z_m of a point.
  PlanePoint step_N(double time_s, const PlanePoint& foot_m) noexcept;
  /// At the end of the hold.
  const PlanePoint& held_N() const noexcept { return held_N_; }
  /// From when the hand took it until it has let go.
  double length_s() const noexcept { return kGone_s + pull_.release_s; }

 private:
  PlanePoint lead_N(double time_s, const PlanePoint& foot_m) noexcept;

  PullAndRelease pull_;
  double step_s_;
  bool first_ = true;
  PlanePoint last_m_, held_N_;
};

}  // namespace sprung
