#include "estimator/torque_bound.h"

#include <cmath>

namespace sprung {

TorqueBound torque_bound(const JointConfig& joint, const TorqueBoundInput& in) noexcept {
  constexpr double kStdsFor95 = 2.0;
  TorqueBound bound;
  bound.static_Nm = kFrictionUncertainty * joint.coulomb_friction_Nm +
                    kTorqueConstantUncertainty * std::abs(in.motor_torque_Nm) + in.current_quantisation_Nm;
  bound.dynamic_Nm = joint.armature_kg_m2 * (kArmatureUncertainty * std::abs(in.acceleration_rad_s2) +
                                             kStdsFor95 * in.acceleration_std_rad_s2) +
                     in.lag_s * std::abs(in.output_torque_rate_Nm_s);
  return bound;
}

}  // namespace sprung
