#pragma once
/// The virtual spring: joint torque for a desired foot motion, without a torque sensor. Pure.
///
///   tau = tau_s + k f(w, tau_s),  tau_s = J^T [ K (P_des - P) + D (s P_des' - P') - f_ground ] + G
///
/// S0 (7) with errata E2 (D resists the actual velocity), E1 (gravity G of the leg, hip fixed), E5 (smooth
/// friction). s is `velocity_feedforward`, f_ground `feedforward_force_N` (ground on foot), k
/// `friction_compensation`, f the friction law with tanh(w / w0) for its sign: nothing at rest, no chatter. w is the
/// measured joint velocity, as in the papers: the compensation then also helps a push from outside, which the desired
/// velocity knows nothing of. It is positive feedback of slope k f / w0, stable as long as k f is below the true
/// friction. Load-dependent friction is that of tau_s, which the gear is to put out, and no measurement: no second
/// feedback.
#include <vector>

#include "controller/foot_motion.h"
#include "estimator/friction/friction_law.h"
#include "robots/robot_config.h"

namespace sprung {

struct LegMotion {
  JointVector position_rad;  ///< estimated
  JointVector velocity_rad_s;
  JointVector temperature_C{};  ///< of the gears; NaN where it is not known: friction's reference temperature
};

struct FrictionCompensation {
  std::vector<FrictionParameters> joints;  ///< of each joint of the leg; presliding plays no part
  double smoothing_rad_s = 0.05;           ///< w0 > 0
};

JointVector compliance_torque_Nm(const LegKinematics& kinematics, const DesiredLeg& desired,
                                 const FootMotion& foot, const LegMotion& leg,
                                 const FrictionCompensation& friction) noexcept;

}  // namespace sprung
