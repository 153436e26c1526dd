#pragma once
/// The virtual spring: joint torque for a desired foot motion, without a torque sensor. Pure.
///
///   tau = tau_s + k f(w, tau_s, tau_k) + c A q_des''
///   tau_s = J^T [ K (P_des - P) + D (s P_des' - P') - f_ground ] + G
///
/// S0 (7) with errata E2 (D resists the actual velocity), E1 (gravity G of the leg, hip fixed), E5 (smooth
/// friction): docs/sources.md, A5. s is `velocity_feedforward`, f_ground `feedforward_force_N` (ground on
/// foot), k `friction_compensation`, c `inertia_compensation`, A the armature.
///
/// Friction. In motion f is the friction law with tanh(w / w0) for its sign: no chatter. w is the
/// measured joint velocity, as in the papers: the compensation then also helps a push from outside, which the
/// desired velocity knows nothing of. It is positive feedback of slope k f / w0, stable as long as k f is
/// below the true friction. Load-dependent friction is that of tau_s, which the gear is to put out, and no
/// measurement: no second feedback. At rest the papers' law gives nothing, and the foot sticks wherever the
/// spring is weaker than friction. The rest law (E5; facts physics 15) takes the sign from where the spring
/// pulls, tau_k = J^T K e alone: tanh(tau_k / tau0). With weight or feed-forward in it, it would push a leg
/// that hangs where it should.
///     k f = h k f_rest + (1 - h) min(k, 1 - u) f_motion,  h = exp(-(w / w_rest)^2)
///     w_rest = 0: k f_motion, the papers' law
/// What a joint that stays stuck adds to k at rest: stuck_friction.h.
/// u is friction's relative uncertainty. What is compensated beyond the true friction drives a motion on (at
/// 0.8 of the friction a foot with k = 0.97 never came to rest), so in motion no more is than there surely
/// is. At rest the spring's sign drives toward the target alone.
///
/// Inertia. q_des'' = J^-1 (P_des'' - J' q'): joint acceleration that the desired foot acceleration asks for
/// here and now.
#include <vector>

#include "model/friction/friction_law.h"
#include "model/posed_leg.h"
#include "robots/robot_config.h"
#include "signals/leg_command.h"

namespace sprung {

/// Desired foot motion between the planner's cycle and now.
struct FootMotion {
  Eigen::Vector3d position_m;
  Eigen::Vector3d velocity_m_s;
  Eigen::Vector3d acceleration_m_s2 = Eigen::Vector3d::Zero();
};

/// Constant acceleration over `age_s`.
inline FootMotion extrapolate(const DesiredLeg& desired, double age_s) noexcept {
  const Eigen::Vector3d velocity = to_eigen(desired.desired_foot_velocity_m_s);
  const Eigen::Vector3d acceleration = to_eigen(desired.desired_foot_acceleration_m_s2);
  return {to_eigen(desired.desired_foot_in_hip_m) + age_s * (velocity + 0.5 * age_s * acceleration),
          velocity + age_s * acceleration, acceleration};
}

struct LegMotion {
  JointVector position_rad;  ///< estimated
  JointVector velocity_rad_s;
  JointVector temperature_C{};  ///< of the gears; NaN where it is not known: friction's reference temperature
};

/// What the law knows of each joint of the leg.
struct JointCompensation {
  std::vector<FrictionParameters> friction;  ///< presliding plays no part
  double smoothing_rad_s = 0.05;             ///< w0 > 0
  RestFrictionConfig rest{};
  std::vector<double> friction_uncertainty{};  ///< u, relative, one standard deviation; empty: 0
  std::vector<double> armature_kg_m2{};        ///< empty: inertia is not compensated
  std::vector<double> stuck_share{};           ///< beside k, at rest (stuck_friction.h); empty: none
};

/// Of the joints of one leg.
struct ComplianceTorque {
  JointVector torque_Nm;         ///< that the gears are to put out, and their friction
  JointVector spring_torque_Nm;  ///< tau_k
  JointVector rest_friction_Nm;  ///< that the law says a joint at rest has, >= 0
};

/// What a leg whose foot is led takes that nothing touches: inverse dynamics of its links, and of rotors and
/// friction the shares that are compensated: of the motion that is wanted, not of the one that is measured.
/// `leg` is that motion, `at` its position.
JointVector led_torque_Nm(const LegKinematics& kinematics, const PosedLeg& at, const DesiredLeg& desired,
                          const FootMotion& foot, const LegMotion& leg,
                          const JointCompensation& joints) noexcept;

ComplianceTorque compliance_torque(const LegKinematics& kinematics, const DesiredLeg& desired,
                                   const FootMotion& foot, const LegMotion& leg,
                                   const JointCompensation& joints) noexcept;

}  // namespace sprung
