#pragma once
/// Friction of one joint's gear by the law of robot.yaml, and what it may be where its sign cannot be known.
/// Pure.
///
/// At rest a gear holds any torque between minus and plus its breakaway torque, so the torque L at its output
/// is only known to lie in an interval around the motor's torque. The estimate is then the last one, moved
/// only where it has become impossible (set membership): it neither jumps to the middle nor chatters with the
/// encoder's noise (docs/sources.md, errata E5).
#include <limits>

#include "estimator/friction_adaptation.h"
#include "model/friction/friction_law.h"
#include "model/friction/presliding_state.h"
#include "robots/robot_config.h"
#include "signals/vec3.h"

namespace sprung {

class GearFrictionEstimator {
 public:
  explicit GearFrictionEstimator(const JointConfig& joint) noexcept;

  /// At rest; the gear holds nothing back: output torque = motor torque.
  void start(double position_rad, double motor_torque_Nm) noexcept;
  /// Friction that the motor's torque meets, by what is known of motion and load so far.
  double ahead_Nm(double motor_torque_Nm) const noexcept;

  struct Motion {
    double measured_position_rad = 0.0;
    double velocity_rad_s = 0.0;
    double velocity_std_rad_s = 0.0;
    double motor_torque_Nm = 0.0;
    double tracked_output_Nm = 0.0;  ///< of the tracking filter: good while the joint moves
    /// Its standard deviation; infinite: not known.
    double tracked_output_std_Nm = std::numeric_limits<double>::infinity();
    double temperature_C = kNaN;  ///< NaN: that at which the law holds
    double dt_s = 0.0;
  };
  void update(const Motion& motion) noexcept;
  /// From now on friction is this much of what robot.yaml's law says.
  void adapt(const FrictionFactors& factors) noexcept;
  /// From another sensor. At rest it is what the next estimate starts from; moving, the filter knows.
  void learn_output(double output_Nm) noexcept;

  double output_torque_Nm() const noexcept { return output_Nm_; }
  const LoadedFriction& friction() const noexcept {
    return friction_;
  }  ///< moving: by the law; at rest: its limits
  /// Friction as estimated: by the law, or at rest the motor's torque less the output's.
  double friction_torque_Nm() const noexcept { return friction_Nm_; }
  /// The same by robot.yaml's law, whatever the factors are.
  FrictionByLaw friction_by_law() const noexcept;
  bool at_rest() const noexcept { return at_rest_; }
  /// Distance from the estimate to the far end of the interval of possible output torques; 0 while moving.
  double rest_distance_Nm() const noexcept { return rest_distance_Nm_; }

 private:
  void decide_rest(const Motion& motion) noexcept;
  /// More than any friction could hold: it only passes through zero speed.
  bool accelerates(const Motion& motion) const noexcept;
  void hold(const Motion& motion) noexcept;
  void follow(const Motion& motion) noexcept;
  FrictionInput input(double velocity_rad_s, double sign, double output_Nm) const noexcept;

  FrictionParameters stated_;  ///< robot.yaml's
  FrictionParameters law_;     ///< as adapted
  FrictionFactors factors_;
  PreslidingState presliding_;
  bool at_rest_ = true;
  double motor_Nm_ = 0.0;  ///< smoothed while at rest: the current's noise must not narrow the interval
  double output_Nm_ = 0.0;
  double friction_Nm_ = 0.0;
  double temperature_C_ = kNaN;
  double rest_distance_Nm_ = 0.0;
  LoadedFriction friction_;
};

}  // namespace sprung
