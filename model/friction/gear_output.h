#pragma once
/// Gear output torque from what the motor has left after its own inertia, friction depending on that very
/// torque: solved in closed form. Pure, no heap.
///
///   L = tau_available - f(w, L),  tau_available = R Kt i - R^2 I qdd
///
/// With d the sign of motion and F0 the friction without load: driving (L d > 0) L = (tau - F0) / (1 +
/// K_driving), driven (L d < 0) L = (tau - F0) / (1 - K_driven). Both are zero together, so the solution is
/// unique and continuous.
#include "model/friction/friction_law.h"

namespace sprung {

struct [[nodiscard]] GearOutput {
  double torque_Nm = 0.0;     ///< at the given sign of motion
  double friction_Nm = 0.0;   ///< tau_available - torque
  double by_available = 1.0;  ///< derivative of torque by tau_available; by a parameter it is - by_available
                              ///< df/dp at this load
  double low_Nm = 0.0;        ///< of all signs in [-1, 1]: at rest friction may have any of them
  double high_Nm = 0.0;
};

/// @param in its gear_output_torque_Nm is not used; at rest without `sign` the torque is that without dry
/// friction, inside [low, high].
GearOutput solve_gear_output(const FrictionParameters& parameters, double available_torque_Nm,
                             const FrictionInput& in) noexcept;

}  // namespace sprung
