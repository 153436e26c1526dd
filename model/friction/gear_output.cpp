#include "model/friction/gear_output.h"

#include <cmath>

namespace sprung {
namespace {

struct Solution {
  double torque_Nm;
  double by_available;
};

Solution solve(const FrictionParameters& parameters, const FrictionAtSpeed& at, double available_Nm,
               double sign) noexcept {
  const FrictionParts parts = friction_parts(parameters, at, sign);
  const double left_Nm = available_Nm - parts.sign * parts.dry_Nm - parts.viscous_Nm;
  const bool drives = left_Nm * parts.sign > 0.0;
  const double by_available = 1.0 / (drives ? 1.0 + std::abs(parts.sign) * parts.driving
                                            : 1.0 - std::abs(parts.sign) * parts.driven);
  return {left_Nm * by_available, by_available};
}

}  // namespace

GearOutput solve_gear_output(const FrictionParameters& parameters, double available_torque_Nm,
                             const FrictionInput& in) noexcept {
  const FrictionAtSpeed at = friction_at_speed(parameters, in);
  const Solution here = solve(parameters, at, available_torque_Nm, at.sign);
  GearOutput out;
  out.torque_Nm = here.torque_Nm;
  out.friction_Nm = available_torque_Nm - here.torque_Nm;
  out.by_available = here.by_available;
  // The torque falls with the sign all the way, so the ends are the extremes.
  out.low_Nm = solve(parameters, at, available_torque_Nm, 1.0).torque_Nm;
  out.high_Nm = solve(parameters, at, available_torque_Nm, -1.0).torque_Nm;
  return out;
}

}  // namespace sprung
