#pragma once
/// One joint's motion and torques from its motor. Pure: no heap after construction, never throws in step.
#include "estimator/friction_adaptation.h"
#include "estimator/gear_friction_estimator.h"
#include "estimator/temperature_filter.h"
#include "estimator/torsion_sensor.h"
#include "estimator/tracking_filter.h"
#include "robots/robot_config.h"
#include "signals/joint_state.h"
#include "signals/vec3.h"

namespace sprung {

/// What the drives say about one joint, already in joint space.
struct JointSample {
  double measured_position_rad = kNaN;       ///< motor side
  double measured_link_position_rad = kNaN;  ///< NaN where there is no link encoder
  double motor_angle_rad = kNaN;             ///< of the joint's own motor
  double motor_torque_Nm = kNaN;             ///< R Kt i through the transmission
  double current_quantisation_Nm = 0.0;
  JointStatus drive_status = JointStatus::kOk;  ///< worst of the drives that move this joint
  bool fresh = false;                           ///< all of them answered this SYNC, and with finite numbers
  bool drive_enabled = false;
  bool untouched = false;  ///< the leg is not known to touch anything: what the model does not explain is
                           ///< friction
  /// What the leg found outside torques on this joint to be in the cycle before; NaN: not known. On a joint
  /// that nothing touches it is what friction differs from its law, by which the gear's temperature is known.
  double last_external_torque_Nm = kNaN;
};

class JointEstimator {
 public:
  /// @param estimation of the robot. @param encoder_step_rad one count of the motor encoder at the joint.
  /// @param longest_coast_cycles samples that may be missing before the joint is stale.
  /// @throws std::invalid_argument where cycles are too long to follow a joint.
  JointEstimator(const JointConfig& joint, const EstimationConfig& estimation, double cycle_s,
                 double encoder_step_rad, int longest_coast_cycles);

  /// Forgets everything: the next fresh sample initialises the filter at its position and at rest.
  void reset() noexcept;
  /// Without a fresh sample the filter coasts on its last acceleration; when that lasts, torques become NaN
  /// and the status stale, and the next fresh sample starts it anew.
  /// @param out written, never read; external_torque_Nm and its bound are the leg's to fill.
  void step(const JointSample& sample, double dt_s, EstimatedJoint& out) noexcept;
  /// By robot.yaml's law, in the last step's motion.
  FrictionByLaw friction_by_law() const noexcept { return friction_.friction_by_law(); }
  /// What a swing of a while ago says about friction; from the next step on.
  void learn_friction(const SeenFriction& seen) noexcept { adaptation_.learn(seen); }

 private:
  void start(const JointSample& sample) noexcept;
  void track(const JointSample& sample, double dt_s) noexcept;
  void use(const JointSample& sample, double dt_s) noexcept;
  void follow_temperature(const JointSample& sample, double dt_s) noexcept;
  JointStatus status(const JointSample& sample) const noexcept;
  double acceleration_rad_s2() const noexcept;
  FrictionInput motion_now() const noexcept;
  double sampling_std_rad() const noexcept;
  void write_motion(EstimatedJoint& out) const noexcept;
  void write_torques(EstimatedJoint& out) const noexcept;
  void fuse_torsion(const JointSample& sample, double dt_s, EstimatedJoint& out) noexcept;

  JointConfig joint_;
  EstimationConfig estimation_;
  double newest_share_;  ///< of the newest current in the mean over a cycle
  double encoder_step_rad_;
  int longest_coast_cycles_;
  int settling_samples_;
  TrackingFilter filter_;
  GearFrictionEstimator friction_;
  FrictionAdaptation adaptation_;
  TemperatureFilter temperature_;
  TorsionZero torsion_zero_;
  double motor_torque_Nm_ = kNaN;
  double input_rad_s2_ = 0.0;  ///< acceleration by the motor alone, now
  double quantisation_Nm_ = 0.0;
  int fresh_samples_ = 0;  ///< since the start, counted up to settling_samples_
  int coasted_cycles_ = 0;
  bool referenced_ = true;
};

}  // namespace sprung
