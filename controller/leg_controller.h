#pragma once
/// One leg's drive set-points from its desired foot motion. Pure: no heap after construction, never throws in
/// step.
///
/// Bumpless: no switch changes a drive's torque by more than 5 % of its limit in a cycle.
///   to position or joints  set-points go over as set_point_blend.h says: from those of before, or from the
///                          measured position and velocity with the torque that the motors give now (none
///                          when the drives were off);
///   to compliance  the difference between the torque measured at the motor and the law's own, soft stops
///                  included, fades: the first set-point is the torque that is there. Stiffness and damping
///                  act in full at once: a ramp of them would slow the jumps of preset `paper`, which switch
///                  in flight (hybrid) or while standing still before the thrust (torque), where this
///                  difference is small;
///   gains          that change in compliance are ramped (gain_ramp.h) where the preset says so.
/// Joint mode is position mode with joint angles in the place of the foot.
/// While not all of the leg's drives are enabled, set-points are the measured position or no torque: enabling
/// never kicks.
#include <memory>
#include <vector>

#include "controller/compliance_law.h"
#include "controller/fade.h"
#include "controller/gain_ramp.h"
#include "controller/position_window.h"
#include "controller/set_point_blend.h"
#include "controller/stuck_friction.h"
#include "controller/torque_limits.h"
#include "model/transmission.h"
#include "signals/drive_command.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"

namespace sprung {

enum class LegOutcome { kOk, kNotFinite, kUnreachable };

class LegController {
 public:
  /// @param preset which friction is compensated, and how smoothly.
  /// @throws std::invalid_argument on kinematics or a transmission that cannot be.
  LegController(const RobotConfig& robot, const LegConfig& leg, const PresetConfig& preset);

  /// Writes this leg's entries of `out`; unless kOk they are to be overwritten with damping.
  /// @param desired_age_s from the command's time to now.
  LegOutcome step(const std::vector<EstimatedJoint>& joints, const DesiredLeg& desired, double desired_age_s,
                  double dt_s, DriveCommand& out) noexcept;
  /// The next step's desires come from elsewhere: they are faded in, as after a change of mode.
  void begin_anew() noexcept { entering_ = true; }
  /// Damping (or no power) instead of a step; the next mode starts anew.
  void damp(DriveCommand& out) noexcept;
  void disable(DriveCommand& out) noexcept;

  const LimitCounts& limits() const noexcept { return counts_; }

 private:
  bool read(const std::vector<EstimatedJoint>& joints) noexcept;
  void compensate_friction(std::size_t j, const EstimatedJoint& joint) noexcept;
  LegOutcome follow(const DesiredLeg& desired, double desired_age_s, double dt_s, DriveCommand& out) noexcept;
  LegOutcome position(const DesiredLeg& desired, const FootMotion& foot, double dt_s,
                      DriveCommand& out) noexcept;
  void feed_forward(const DesiredLeg& desired, const FootMotion& foot, const PosedLeg& at,
                    const SetPoints& to) noexcept;
  LegOutcome joint(const DesiredLeg& desired, double desired_age_s, double dt_s, DriveCommand& out) noexcept;
  void send_position(const SetPoints& desired, double dt_s, DriveCommand& out) noexcept;
  LegOutcome compliance(const DesiredLeg& desired, const FootMotion& foot, double dt_s,
                        DriveCommand& out) noexcept;
  void send(const SetPoints& actuators, double dt_s, DriveCommand& out) noexcept;
  void forget_stuck() noexcept;
  void learn_stuck(const DesiredLeg& acting, const ComplianceTorque& law, double dt_s) noexcept;
  void enter_position(const SetPoints& desired, double dt_s) noexcept;
  void enter_compliance(const JointVector& law_Nm, double dt_s) noexcept;
  void add_soft_stops(JointVector& torque_Nm) noexcept;
  void clamp_to_limits(double dt_s, JointVector& position_rad, JointVector& velocity_rad_s) noexcept;
  ActuatorCommand& command(DriveCommand& out, int i) const noexcept;
  void fill(DriveCommand& out, DriveMode mode) const noexcept;

  std::vector<int> joint_indices_;
  std::vector<int> actuator_indices_;
  std::vector<JointConfig> joints_;
  std::vector<ActuatorConfig> actuators_;
  std::unique_ptr<LegKinematics> kinematics_;  ///< nullptr: joints alone, no foot to command
  Transmission transmission_;
  JointCompensation compensation_;  ///< friction: of this cycle
  std::vector<FrictionParameters> friction_laws_;
  std::vector<double> known_friction_;  ///< relative uncertainty where the model fits
  bool learns_friction_;  ///< the preset's law is robot.yaml's own, beside which something may be learnt

  ControlMode mode_ = ControlMode::kDisabled;  ///< of this step
  /// Of the step before; kDisabled while not all drives were on.
  ControlMode before_ = ControlMode::kDisabled;
  bool all_enabled_ = false;
  bool entering_ = true;   ///< this step is the mode's first with enabled drives
  SetPointBlend blend_;    ///< position and joint mode
  SetPoints sent_;         ///< position and joint mode: of the joints, without the blend's torque
  Fade fade_;              ///< compliance
  JointVector offset_Nm_;  ///< what fades in compliance
  GainRamp gains_;
  std::vector<StuckFriction> stuck_;      ///< compliance
  JointVector lowest_rad_, highest_rad_;  ///< position mode: between them each joint's set-point may be
  LegMotion measured_;
  JointVector motor_torque_Nm_;          ///< of this step, as measured
  std::vector<TorqueLimiter> limiters_;  ///< compliance
  std::vector<PositionWindow> windows_;  ///< position and joint mode
  LimitCounts counts_;
};

}  // namespace sprung
