#include "estimator/torque_bound.h"

#include <cmath>

namespace sprung {
namespace {

double sum_of_squares(double a, double b = 0.0, double c = 0.0, double d = 0.0) noexcept {
  return a * a + b * b + c * c + d * d;
}

}  // namespace

TorqueBounds torque_bounds(const JointConfig& joint, const TorqueBoundInput& in) noexcept {
  const JointUncertainty& relative = joint.uncertainty;
  const double model_variance = sum_of_squares(
      in.friction_std_Nm, relative.torque_constant * in.motor_torque_Nm,
      relative.armature * joint.armature_kg_m2 * in.acceleration_rad_s2,
      0.5773502691896258 * in.current_quantisation_Nm);  // evenly spread: 1 / sqrt 3
  const double filter_variance = sum_of_squares(joint.armature_kg_m2 * in.filter_std_rad_s2,
                                                joint.armature_kg_m2 * in.filter_step_rad_s2);
  const double model_Nm = kModelStds * in.by_friction * std::sqrt(model_variance);
  const double filter_Nm = kFilterStds * std::sqrt(filter_variance);
  return {std::sqrt(sum_of_squares(model_Nm, filter_Nm, in.rest_distance_Nm)),
          std::sqrt(sum_of_squares(kModelStds * in.friction_std_Nm, in.rest_distance_Nm))};
}

}  // namespace sprung
