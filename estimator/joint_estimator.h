#pragma once
/// One joint's motion and torques from its motor. Pure: no heap after construction, never throws in step.
#include "estimator/tracking_filter.h"
#include "robots/robot_config.h"
#include "signals/signals.h"

namespace sprung {

/// What the drives say about one joint, already in joint space.
struct JointSample {
  double measured_position_rad = kNaN;
  double motor_torque_Nm = kNaN;  ///< R Kt i through the transmission
  double current_quantisation_Nm = 0.0;
  JointStatus drive_status = JointStatus::kOk;  ///< worst of the drives that move this joint
  bool fresh = false;                           ///< all of them answered this SYNC, and with finite numbers
  bool drive_enabled = false;
};

class JointEstimator {
 public:
  /// @param encoder_step_rad one count of the motor encoder at the joint.
  /// @param longest_coast_cycles samples that may be missing before the joint is stale.
  JointEstimator(const JointConfig& joint, double cycle_s, double encoder_step_rad, int longest_coast_cycles);

  /// Forgets everything: the next fresh sample initialises the filter at its position and at rest.
  void reset() noexcept;
  /// Without a fresh sample the filter coasts on its last acceleration; when that lasts, torques become NaN
  /// and the status stale, and the next fresh sample starts it anew. `out.external_torque_Nm` is the leg's to
  /// fill.
  void step(const JointSample& sample, double dt_s, EstimatedJoint& out) noexcept;

 private:
  void start(const JointSample& sample) noexcept;
  void track(const JointSample& sample, double dt_s) noexcept;
  JointStatus status(const JointSample& sample) const noexcept;
  void write_motion(EstimatedJoint& out) const noexcept;
  void write_torques(double dt_s, EstimatedJoint& out) noexcept;
  double motor_acceleration(double motor_torque_Nm) const noexcept;

  JointConfig joint_;
  TrackingGains gains_;
  double acceleration_std_rad_s2_;
  int longest_coast_cycles_;
  TrackingState state_;
  double motor_torque_Nm_ = kNaN;
  double input_rad_s2_ = 0.0;
  double output_torque_Nm_ = kNaN;
  double quantisation_Nm_ = 0.0;
  int settling_samples_;
  int fresh_samples_ = 0;  ///< since the start, counted up to settling_samples_
  int coasted_cycles_ = 0;
};

}  // namespace sprung
