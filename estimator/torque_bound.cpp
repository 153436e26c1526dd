#include "estimator/torque_bound.h"

#include <cmath>

namespace sprung {

double torque_bound_Nm(const JointConfig& joint, const TorqueBoundInput& in) noexcept {
  constexpr double kStdsFor95 = 2.0;
  const double friction_Nm =
      (1.0 + kFrictionUncertainty) * joint.coulomb_friction_Nm - std::abs(in.friction_torque_Nm);
  const double motor_Nm =
      kTorqueConstantUncertainty * std::abs(in.motor_torque_Nm) + in.current_quantisation_Nm;
  const double inertia_Nm = joint.armature_kg_m2 * (kArmatureUncertainty * std::abs(in.acceleration_rad_s2) +
                                                    kStdsFor95 * in.acceleration_std_rad_s2);
  return friction_Nm + motor_Nm + inertia_Nm + in.lag_s * std::abs(in.output_torque_rate_Nm_s);
}

}  // namespace sprung
