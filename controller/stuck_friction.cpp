#include "controller/stuck_friction.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

constexpr double kGrowth_1_s = 2.0;    // a third more friction is found within what a foot takes to return
constexpr double kStuck_rad_s = 0.05;  // creeping is as good as stuck
constexpr double kForget_s = 0.1;
constexpr double kDead = 3.0;  // of tau0: there the rest law gives all that it has

}  // namespace

void StuckFriction::step(const StuckMoment& now, double dt_s) noexcept {
  if (!(rest_.most > 0.0) || !(now.rest_friction_Nm > 0.0)) return;
  if (!(now.compensated_share > 0.0)) return reset();
  const double pull_Nm = std::abs(now.spring_torque_Nm);
  const bool stuck = std::abs(now.velocity_rad_s) < kStuck_rad_s;
  const bool pulls = pull_Nm > kDead * rest_.torque_Nm;
  const bool likely = pull_Nm <= (1.0 + rest_.most - now.compensated_share) * now.rest_friction_Nm;
  if (stuck && pulls && likely) share_ = std::min(rest_.most, share_ + kGrowth_1_s * dt_s);
  if (!stuck && now.velocity_rad_s * now.spring_torque_Nm < 0.0)
    share_ *= std::max(0.0, 1.0 - dt_s / kForget_s);
}

}  // namespace sprung
