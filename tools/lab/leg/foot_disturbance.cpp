#include "tools/lab/leg/foot_disturbance.h"

#include <algorithm>
#include <cmath>

namespace sprung {

std::vector<PullAndRelease> pulls_and_releases() {
  constexpr double kEighth_rad = 0.25 * 3.14159265358979323846;
  std::vector<PullAndRelease> out;
  for (int direction = 0; direction < 8; ++direction) {
    for (int pull = 0; pull < 5; ++pull)
      out.push_back({kEighth_rad * direction, 8e-3 * (pull + 1), 1.0 + 0.5 * ((pull + 2 * direction) % 5)});
  }
  return out;
}

PlanePoint FootDisturbance::step_N(double time_s, const PlanePoint& foot_m) noexcept {
  if (time_s < kGone_s) return held_N_ = lead_N(time_s, foot_m);
  const double left = std::max(0.0, 1.0 - (time_s - kGone_s) / pull_.release_s);
  return {left * held_N_.x_m, left * held_N_.z_m};
}

PlanePoint FootDisturbance::lead_N(double time_s, const PlanePoint& foot_m) noexcept {
  const double x = std::min(1.0, time_s / kReach_s);
  const double way_m = pull_.distance_m * x * x * (3.0 - 2.0 * x);
  if (first_) last_m_ = foot_m;
  first_ = false;
  const auto axis_N = [&](double lead_m, double at_m, double before_m, double& grown_N) {
    grown_N += grip_.growth_N_m_s * step_s_ * (lead_m - at_m);
    return grown_N + grip_.stiffness_N_m * (lead_m - at_m) -
           grip_.damping_N_s_m * (at_m - before_m) / step_s_;
  };
  const double c = std::cos(pull_.direction_rad), s = std::sin(pull_.direction_rad);
  const PlanePoint force_N{axis_N(way_m * c, foot_m.x_m, last_m_.x_m, grown_N_.x_m),
                           axis_N(way_m * s, foot_m.z_m, last_m_.z_m, grown_N_.z_m)};
  last_m_ = foot_m;
  return force_N;
}

}  // namespace sprung
