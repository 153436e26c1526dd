#pragma once
/// Joint torque from motor current and encoder, without a torque sensor. Pure: no I/O, clock, log or heap in
/// step.
///
///   motor-side torque  = R Kt i - tau_f               S0 (6) as printed: the papers' "joint torque"
///   gear output torque = R Kt i - tau_f - R^2 I qdd   errata E6
///
/// The inertia term is 40-80 times the friction in a jump. S0 (6) and E6 stand in docs/sources.md.
///
/// qdd comes from a Kalman filter on encoder and motor torque, not from differences. tau_f is the law of
/// robot.yaml, the papers' Coulomb where a joint is not identified; at rest its sign is unknown, and the
/// estimate is the last one that is possible (docs/estimation.md). Joint status, NaN torques and `starting`
/// are the answer to silent drives and numbers that are not finite. Sign: positive torque accelerates the
/// joint toward +q. Joint space through each leg's transmission.
#include <memory>

#include "robots/robot_config.h"
#include "signals/body_state.h"
#include "signals/drive_state.h"
#include "signals/joint_state.h"
#include "signals/sensors.h"

namespace sprung {

class EstimatorCore {
 public:
  /// Of robot.watchdogs, or of the given set: a drive that is silent for longer than silent_cycles makes its
  /// joint stale; a gap in message time above joint_state starts the filters anew, since their prediction is
  /// worth nothing then.
  explicit EstimatorCore(const RobotConfig& robot);
  EstimatorCore(const RobotConfig& robot, const WatchdogConfig& watchdogs);
  ~EstimatorCore();
  EstimatorCore(const EstimatorCore&) = delete;
  EstimatorCore& operator=(const EstimatorCore&) = delete;

  /// JOINT_STATE(k) from DRIVE_STATE(k). `out` must have been sized for this robot. dt is the difference of
  /// utime. A repeated seq gives the same answer again; a seq or time that goes back, or a gap above
  /// joint_state, starts the filters anew.
  /// @param imu newest sample, for a robot with a body (robot.body); nullptr: none. Other robots' JOINT_STATE
  /// does not depend on it, and says nothing of a body.
  void step(const DriveState& in, JointState& out, const Imu* imu = nullptr) noexcept;
  /// BODY_STATE of the newest cycle. @return false: a robot without a trunk, `out` is left as it is.
  bool body_state(BodyState& out) const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sprung
