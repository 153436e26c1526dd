#pragma once
/// JOINT_STATE: what the estimator makes of a cycle's measurements. Units and frames: lcmtypes/README.md.
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "signals/modes.h"
#include "signals/stamp.h"
#include "signals/vec3.h"

namespace sprung {

/// misfit_ratio from which on a joint's model does not fit (estimator/model_watch.h).
inline constexpr double kMisfitRatio = 2.5;

struct EstimatedJoint {
  double estimated_position_rad = kNaN;
  double estimated_velocity_rad_s = kNaN;
  double estimated_acceleration_rad_s2 = kNaN;
  double measured_motor_torque_Nm = kNaN;  ///< R Kt i through the transmission, before friction and inertia
  double motor_side_torque_Nm = kNaN;      ///< the papers' joint torque: the above minus their friction
  double gear_output_torque_Nm = kNaN;
  double gear_output_torque_bound_Nm = kNaN;
  double friction_torque_Nm = kNaN;
  double external_torque_Nm = kNaN;
  double estimated_position_bound_rad = kNaN;
  double estimated_velocity_bound_rad_s = kNaN;
  double estimated_acceleration_bound_rad_s2 = kNaN;
  double friction_torque_bound_Nm = kNaN;
  double external_torque_bound_Nm = kNaN;
  double torsion_torque_Nm = kNaN;  ///< from motor and link encoder; NaN where there is no link encoder
  double estimated_temperature_degC = kNaN;
  double misfit_ratio = 0.0;  ///< how far motion shows the model to be off, in standard deviations of
                              ///< robot.yaml's `uncertainty`; 0 until there was motion in the air
  double
      winding_share = kNaN;  ///< of the warmest motor that moves it; 1: as warm as the rated current makes it
  double derating_in_s = kNaN;           ///< until then, at the current of late; NaN: never
  double dry_friction_factor = 1.0;      ///< as learnt in motion, of what robot.yaml's law says
  double viscous_friction_factor = 1.0;  ///< the same
  JointStatus status = JointStatus::kStarting;
  bool drive_enabled = false;
  bool identified = false;  ///< friction and armature come from `sprung identify`
  bool at_rest = false;  ///< friction's sign is not known: torques are the last possible, bounds the far end
  bool model_fits = true;  ///< false: friction, inertia or torque constant are not what robot.yaml says
  MisfitReason misfit_reason = MisfitReason::kNone;  ///< the likely one
};

struct EstimatedLeg {
  Vec3 estimated_foot_in_hip_m{kNaN, kNaN, kNaN};
  Vec3 estimated_foot_velocity_m_s{kNaN, kNaN, kNaN};
  Vec3 foot_force_N{kNaN, kNaN, kNaN};
  Vec3 foot_force_bound_N{kNaN, kNaN, kNaN};
  double contact_confidence = 0.0;
  bool contact = false;
};

/// Attitude and motion of the trunk. Trunk axes: x forward, y left, z up; yaw counts from the first sample.
struct EstimatedBody {
  std::array<double, 4> estimated_quaternion_wxyz{kNaN, kNaN, kNaN,
                                                  kNaN};    ///< turns trunk axes into world axes
  Vec3 estimated_angular_velocity_rad_s{kNaN, kNaN, kNaN};  ///< trunk axes
  Vec3 estimated_velocity_m_s{kNaN, kNaN, kNaN};            ///< trunk axes; NaN while no foot stands
  double estimated_height_m = kNaN;  ///< of the trunk's hips' middle over the feet that stand
  bool uses_imu = false;             ///< false: attitude is that of the plane through the standing feet
};

struct JointState {
  Stamp stamp;
  EstimatedBody body;
  std::vector<EstimatedJoint> joints;
  std::vector<EstimatedLeg> legs;
  SafetyLevel safety = SafetyLevel::kDisabled;
  std::int64_t used_drive_state_seq = -1;
  std::int64_t used_imu_seq = -1;  ///< newest that had come; -1 = none yet, or a robot without body.imu
  JointState() = default;
  JointState(std::size_t joint_count, std::size_t leg_count) : joints(joint_count), legs(leg_count) {}
};

}  // namespace sprung
