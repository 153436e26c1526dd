#pragma once
/// One leg: joints, foot, foot force and contact. Pure: no heap after construction.
#include <memory>
#include <optional>
#include <vector>

#include "estimator/contact_detector.h"
#include "estimator/drive_sampler.h"
#include "estimator/joint_estimator.h"
#include "estimator/leg_windings.h"
#include "estimator/model_watch.h"
#include "model/leg_kinematics.h"
#include "signals/drive_state.h"
#include "signals/joint_state.h"

namespace sprung {

class LegEstimator {
 public:
  /// @throws std::invalid_argument on kinematics, transmission or contact settings that cannot be.
  LegEstimator(const RobotConfig& robot, const LegConfig& leg, int longest_coast_cycles);

  void reset() noexcept;
  /// Writes this leg's entries of `joints` (all of the robot's) and `out`, whatever they held: nothing of an
  /// output is state. What is not known is NaN.
  void step(const std::vector<ActuatorState>& actuators, double dt_s, std::vector<EstimatedJoint>& joints,
            EstimatedLeg& out) noexcept;
  /// Of this cycle: angular velocity of the last link, hip axes. Not finite where the joints are not known.
  const Eigen::Vector3d& last_link_rate_rad_s() const noexcept { return last_link_rate_rad_s_; }

 private:
  void sample(const std::vector<ActuatorState>& actuators) noexcept;
  void step_joints(double dt_s, std::vector<EstimatedJoint>& joints) noexcept;
  void write_motion(EstimatedLeg& out) noexcept;
  void step_foot(double dt_s, std::vector<EstimatedJoint>& joints, EstimatedLeg& out) noexcept;
  /// Force that, beside the drives, explains the leg's motion: external torque = M qdd + V + G - gear output
  /// torque (positive accelerates the joint toward +q), force on the foot = J^-T external torque. The hip's
  /// own acceleration is not known and left out (docs/sources.md, errata E16): the error is at most the leg's
  /// own weight in flight, and is in the bounds.
  void write_force(std::vector<EstimatedJoint>& joints, EstimatedLeg& out) noexcept;
  double late_torque_Nm(std::size_t j, double motor_torque_Nm, double dt_s) noexcept;
  void gather_evidence(double dt_s, const std::vector<EstimatedJoint>& joints) noexcept;
  /// @param j of this leg. The leg's own torques are those of this cycle once write_force() was there.
  WatchedMotion watched(std::size_t j, const EstimatedJoint& joint) const noexcept;
  /// A model that does not fit makes all bounds wider, at once.
  void widen_bounds(std::size_t j, EstimatedJoint& joint) const noexcept;
  /// @param force_N vertical, on the foot, as estimated.
  void watch_models(double force_N, double dt_s, std::vector<EstimatedJoint>& joints) noexcept;
  double motor_power_W(std::size_t j) const noexcept;  ///< mechanical, positive: drives
  double motor_power_W() const noexcept;               ///< of the leg
  bool moves_itself(std::size_t j) const noexcept;
  bool moved_from_outside(std::size_t j) const noexcept;
  void watch_force(const ContactEstimate& contact, double dt_s,
                   const std::vector<EstimatedJoint>& joints) noexcept;

  std::vector<int> joints_;  ///< indices of this leg's joints in the robot
  std::vector<JointConfig> configs_;
  std::vector<FrictionParameters> friction_laws_;
  DriveSampler sampler_;
  LegWindings windings_;
  std::unique_ptr<LegKinematics> kinematics_;  ///< nullptr: joints alone
  std::optional<ContactDetector> contact_;     ///< of the foot, where there is one
  double unnoticed_N_;                         ///< force on a foot that may go unnoticed
  double pulling_s_ = 0.0;                     ///< how long the ground has seemed to pull
  std::vector<JointEstimator> estimators_;
  std::vector<ModelWatch> watches_;
  std::vector<JointSample> samples_;
  std::vector<ContactEvidence> evidence_;
  std::vector<double> last_motor_torque_Nm_;
  std::vector<double> no_jump_Nm_;  ///< change of a motor torque in a cycle that is none
  JointVector position_rad_, velocity_rad_s_, acceleration_rad_s2_, output_torque_Nm_;
  JointVector link_torque_Nm_, weight_Nm_, external_bound_Nm_;
  JointVector external_torque_Nm_;  ///< until the next cycle, which begins with it; NaN: not known
  LegPose pose_;                    ///< of this cycle, as jacobian_
  LegJacobian jacobian_;
  Eigen::Vector3d last_link_rate_rad_s_ = Eigen::Vector3d::Constant(kNaN);
};

}  // namespace sprung
