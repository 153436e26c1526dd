#pragma once
/// Friction of one joint that is not quite what robot.yaml's law says: on another day, warm, worn. Learned
/// while the robot works, where its swings show it. Pure: no heap, never throws.
///
///   friction = d dry part of the law + v viscous part of the law
///
/// d and v are 1 at first and known as well as robot.yaml's `uncertainty` says; a Kalman filter holds both.
/// Slow: a whole swing counts as one observation, for what else may be wrong in it (inertia, torque constant,
/// weight, the hip's own acceleration) is wrong all through it. Bounded: by twice the stated uncertainty;
/// friction that differs by more is model_watch.h's to tell. Learns nothing while the leg may be touched, nor
/// for a swing after something has moved it that no friction can be; forgets as a gear cools.
#include "model/friction/friction_parameters.h"

namespace sprung {

/// Friction in some motion by robot.yaml's law, with the sign of the motion.
struct FrictionByLaw {
  double dry_Nm = 0.0, viscous_Nm = 0.0;
  double torque_Nm(const FrictionFactors& factors) const noexcept {
    return factors.dry * dry_Nm + factors.viscous * viscous_Nm;
  }
};

/// What a moment of motion in the air says.
struct SeenFriction {
  FrictionByLaw law{};
  double excess_Nm = 0.0;  ///< what moved the joint less than the model says, factors in force: more friction
  double other_std_Nm = 0.0;  ///< of the excess, by all that is not friction
  double time_s = 0.0;        ///< that it lasted
  bool moves_itself = true;   ///< its motor drives; else no friction is seen, only what else moves it
};

class FrictionAdaptation {
 public:
  /// @param uncertainty of friction, relative, one standard deviation. @param learns false: the factors stay
  /// 1.
  FrictionAdaptation(double uncertainty, bool learns) noexcept;

  /// Time that passes, whether anything is learnt or not.
  void age(double dt_s) noexcept;
  void learn(const SeenFriction& seen) noexcept;

  const FrictionFactors& factors() const noexcept { return factors_; }
  /// One standard deviation of the friction that the factors in force make of this. Never above what
  /// robot.yaml states; what position, load and hysteresis do to friction no factor learns.
  double std_Nm(const FrictionByLaw& law) const noexcept;

 private:
  double variance_Nm2(const FrictionByLaw& law) const noexcept;
  /// Something moves the joint, or did within a swing.
  bool touched(const SeenFriction& seen) noexcept;
  void move(double& factor, double by) const noexcept;

  double uncertainty_;
  bool learns_;
  double prior_ = 0.0, prior_both_ = 0.0;  ///< variance of each factor; covariance of the two
  FrictionFactors factors_;
  double dry_ = 0.0, viscous_ = 0.0, both_ = 0.0;  ///< the same now
  double touched_s_ = 0.0;                         ///< of motion, until it learns again
};

}  // namespace sprung
