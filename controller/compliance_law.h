#pragma once
/// The virtual spring: joint torque for a desired foot motion, without a torque sensor. Pure.
///
///   tau = J^T [ K (P_des - P) + D (s P_des' - P') - f ] + G + k tau_c tanh(w / w0)
///
/// S0 (7) with errata E2 (D resists the actual velocity), E1 (gravity G of the leg, hip fixed), E5 (smooth
/// friction). s is `velocity_feedforward`, f `feedforward_force_N` (ground on foot), k
/// `friction_compensation`. w is the measured joint velocity, as in the papers: the compensation then also
/// helps a push from outside, which the desired velocity knows nothing of. It is positive feedback of slope k
/// tau_c / w0, stable as long as k tau_c is below the true friction.
#include <vector>

#include "controller/foot_motion.h"
#include "robots/robot_config.h"

namespace sprung {

struct LegMotion {
  JointVector position_rad;  ///< estimated
  JointVector velocity_rad_s;
};

/// @param coulomb_Nm identified friction of each joint. @param smoothing_rad_s w0 > 0.
JointVector compliance_torque_Nm(const LegKinematics& kinematics, const DesiredLeg& desired,
                                 const FootMotion& foot, const LegMotion& leg, const JointVector& coulomb_Nm,
                                 double smoothing_rad_s) noexcept;

}  // namespace sprung
