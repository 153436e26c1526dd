#include "estimator/friction/gear_output.h"

#include <cmath>

namespace sprung {
namespace {

struct Solution {
  double torque_Nm;
  double by_available;
};

Solution solve(const FrictionParameters& parameters, double available_Nm, const FrictionInput& in) noexcept {
  const FrictionParts parts = friction_parts(parameters, in);
  const double left_Nm = available_Nm - parts.sign * parts.dry_Nm - parts.viscous_Nm;
  const bool drives = left_Nm * parts.sign > 0.0;
  const double by_available =
      1.0 / (drives ? 1.0 + std::abs(parts.sign) * parts.driving : 1.0 - std::abs(parts.sign) * parts.driven);
  return {left_Nm * by_available, by_available};
}

}  // namespace

GearOutput solve_gear_output(const FrictionParameters& parameters, double available_torque_Nm,
                             const FrictionInput& in) noexcept {
  const Solution here = solve(parameters, available_torque_Nm, in);
  FrictionInput extreme = in;
  GearOutput out;
  out.torque_Nm = here.torque_Nm;
  out.friction_Nm = available_torque_Nm - here.torque_Nm;
  out.by_available = here.by_available;
  extreme.sign = 1.0;  // the torque falls with the sign all the way, so the ends are the extremes
  out.low_Nm = solve(parameters, available_torque_Nm, extreme).torque_Nm;
  extreme.sign = -1.0;
  out.high_Nm = solve(parameters, available_torque_Nm, extreme).torque_Nm;
  return out;
}

}  // namespace sprung
