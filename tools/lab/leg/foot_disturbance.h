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

/// How a hand holds a foot that it feels once a cycle: by a spring and a damper, and a force that grows for
/// as long as the foot is behind.
struct HandGrip {
  double stiffness_N_m = 0.0, growth_N_m_s = 0.0, damping_N_s_m = 0.0;
};
/// [design choice] Leads from behind, so that the foot never goes back before the release: friction then
/// stays on the side that resists the pull.
inline constexpr HandGrip kFirmGrip{5e4, 0.0, 500.0};
/// [design choice] A foot behind an elastic gear is light, and would swing in a firm hand.
inline constexpr HandGrip kSoftGrip{3000.0, 1.5e4, 20.0};

/// One pull.
class FootDisturbance {
 public:
  static constexpr double kReach_s = 1.0, kHold_s = 0.5;
  static constexpr double kGone_s = kReach_s + kHold_s;  ///< from then on the force fades

  FootDisturbance(const PullAndRelease& pull, const HandGrip& grip, double step_s) noexcept
      : pull_(pull), grip_(grip), step_s_(step_s) {}
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
  HandGrip grip_;
  double step_s_;
  bool first_ = true;
  PlanePoint last_m_, grown_N_, held_N_;
};

}  // namespace sprung
