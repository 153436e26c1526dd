#pragma once
/// Geometry and statics of one leg. Pure: no I/O, clock, log or heap after construction; safe in the loop.
/// Frame: hip axes, x forward, y left, z up, origin at the hip (three_joint.h: on the abduction axis). The
/// papers' planar y is our z. Equations: docs/control.md, "Leg kinematics"; where they come from:
/// docs/sources.md, A5 and A6. Joint torques are positive along their joint's positive direction; forces are
/// in N, on the foot, in hip axes.
#include <Eigen/Core>
#include <memory>

#include "model/leg_config.h"
#include "signals/vec3.h"

namespace sprung {

inline constexpr int kMaxLegJoints = 6;
inline constexpr double kGravity_m_s2 = 9.81;  ///< as in facts C2 and in the simulated plant

/// One value for each joint of a leg; sized at run time, stored in place.
using JointVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMaxLegJoints, 1>;
/// d foot / d joints, 3 x joints.
using LegJacobian = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, kMaxLegJoints>;

struct [[nodiscard]] InverseResult {
  JointVector position_rad;
  bool reachable = false;  ///< false: position_rad is the nearest pose, arguments clamped (errata E4)
};

/// Damped inverse W = J (J^T J + lambda^2 1)^-1, 3 x joints. Away from singular poses lambda is zero, and
/// then joint velocity = W^T * foot velocity and force on the foot that balances joint torques = W * torque.
struct [[nodiscard]] DampedInverse {
  LegJacobian matrix;
  bool singular = false;  ///< damped: leg nearly straight or folded, W is too small in the lost direction
};

struct SineCosine {
  double sine = 0.0;
  double cosine = 1.0;
};

/// Directions of a leg's links: all that foot, forces and torques take from joint angles, so that who asks
/// several questions about one pose works the sines out once (LegKinematics::pose). What a kinematics does
/// not have stays as it is here.
struct LegPose {
  SineCosine abduction;  ///< of the leg's plane
  SineCosine thigh;      ///< in the plane; of one_link: its arm
  SineCosine shank;      ///< in the plane: thigh less knee
};

class LegKinematics {
 public:
  virtual ~LegKinematics() = default;

  virtual int joint_count() const noexcept = 0;
  virtual LegPose pose(const JointVector& position_rad) const noexcept = 0;
  virtual Eigen::Vector3d foot_in_hip_m(const LegPose& pose) const noexcept = 0;
  virtual LegJacobian jacobian(const LegPose& pose) const noexcept = 0;
  /// Angular velocity of the last link, hip axes: a ball at its end rolls with it.
  virtual Eigen::Vector3d last_link_rate_rad_s(const LegPose& pose,
                                               const JointVector& velocity_rad_s) const noexcept = 0;
  /// J' q': what the foot accelerates by while the joints move evenly.
  virtual Eigen::Vector3d even_motion_acceleration_m_s2(const LegPose& pose,
                                                        const JointVector& velocity_rad_s) const noexcept = 0;
  /// Of the poses that reach the foot, the one with the knee bent as in `near_rad`, turned by 2 pi toward it.
  /// A foot that is not finite: near_rad, not reachable.
  virtual InverseResult inverse(const Eigen::Vector3d& foot_in_hip_m,
                                const JointVector& near_rad) const noexcept = 0;
  /// Torque that holds the leg's own weight with the hip at rest: gradient of the potential energy, errata
  /// E1.
  virtual JointVector gravity_torque_Nm(const LegPose& pose) const noexcept = 0;
  /// Torque at the gear outputs for this motion of the links, hip fixed (errata E16: in flight and in stance
  /// the hip accelerates, which this leaves out): M qdd + V + G. Rotors are not in it.
  virtual JointVector inverse_dynamics_Nm(const LegPose& pose, const JointVector& velocity_rad_s,
                                          const JointVector& acceleration_rad_s2) const noexcept = 0;

  /// The same for who asks one question alone.
  Eigen::Vector3d foot_in_hip_m(const JointVector& position_rad) const noexcept {
    return foot_in_hip_m(pose(position_rad));
  }
  LegJacobian jacobian(const JointVector& position_rad) const noexcept {
    return jacobian(pose(position_rad));
  }
  JointVector gravity_torque_Nm(const JointVector& position_rad) const noexcept {
    return gravity_torque_Nm(pose(position_rad));
  }
  JointVector inverse_dynamics_Nm(const JointVector& position_rad, const JointVector& velocity_rad_s,
                                  const JointVector& acceleration_rad_s2) const noexcept {
    return inverse_dynamics_Nm(pose(position_rad), velocity_rad_s, acceleration_rad_s2);
  }
};

/// @return nullptr for joints alone (kNoKinematics).
/// @throws std::invalid_argument naming the leg on unknown kinematics, or on counts that do not fit them.
std::unique_ptr<LegKinematics> make_leg_kinematics(const LegConfig& leg);

/// Damps where the smallest singular value of J is below 0.02 m (1/13 of the shorter link of single_leg: 5
/// degrees from straight), by Nakamura and Hanafusa's law lambda^2 = lambda0^2 (1 - (sigma / sigma0)^2), so
/// that W is continuous.
DampedInverse damped_inverse(const LegJacobian& jacobian) noexcept;

inline Eigen::Vector3d to_eigen(const Vec3& v) noexcept { return {v[0], v[1], v[2]}; }
inline Vec3 to_vec3(const Eigen::Vector3d& v) noexcept { return {v.x(), v.y(), v.z()}; }

}  // namespace sprung
