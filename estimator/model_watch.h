#pragma once
/// Does one joint's model fit the motion that is seen? Pure: no heap after construction, never throws.
///
/// While nothing touches the leg, the torque that the model leaves unexplained is the model's own error:
///
///   -unexplained = c s + b w + k |L| s + x_J J qdd - x_k R Kt i + x_w G + x_o O + noise,   s = sgn(w)
///
/// c, b and k are what friction is more than its law says, x shares of inertia, torque constant and weight; O
/// is the torque of a force that is not noticed as contact. Its law is robot.yaml's: what is learnt besides
/// (friction_adaptation.h) is taken out again. A Kalman filter holds the seven. The joint does
/// not fit when what c to x_k come to, over the motion of the last 0.3 s and less kSure of its own standard
/// deviations, is more than kMisfitRatio of the standard deviations that robot.yaml's `uncertainty` states;
/// it fits again below kFit. What touches the leg does not teach: nothing is learnt while it may be in
/// contact, nor from what is younger than 40 ms; there the watch is frozen.
#include <array>
#include <cstddef>

#include "estimator/friction_adaptation.h"
#include "model/friction/friction_parameters.h"
#include "robots/identification_config.h"
#include "signals/modes.h"

namespace sprung {

/// One joint in one cycle. Torques at the joint.
struct WatchedMotion {
  double velocity_rad_s = 0.0;
  double sign = 0.0;               ///< s; where that of the motion is not known, 1 for the worse
  double output_torque_Nm = 0.0;   ///< gear output as estimated
  double inertia_torque_Nm = 0.0;  ///< armature times acceleration
  double motor_torque_Nm = 0.0;
  double weight_Nm = 0.0;    ///< G, of the leg at this joint
  double friction_Nm = 0.0;  ///< as estimated
  FrictionByLaw friction_by_law{};
  double adapted_Nm = 0.0;      ///< of friction_Nm, what was learnt beside the law
  double link_torque_Nm = 0.0;  ///< L where nothing touches the leg: M qdd + V + G by its model
  bool moves_itself = true;     ///< its motor and those of the leg drive; else no friction is seen
  double unnoticed_Nm = 0.0;    ///< O, one standard deviation
};

class ModelWatch {
 public:
  /// @param foreign_Nm 0; what the joint's actuator can give, where the law is another robot's: then its
  /// friction may be any gear's of that size, and it does not fit until motion has told.
  ModelWatch(const JointUncertainty& stated, const FrictionParameters& law, double foreign_Nm) noexcept;

  /// Forgets all: the joint fits until it is seen not to, and a foreign one does not until it is seen to.
  void reset() noexcept;
  /// In a cycle in which nothing touches the leg and the drive moves the joint.
  /// @param unexplained_Nm external torque as estimated. @param noise_std_Nm of it, by the motion filter.
  /// @return what became old enough in this cycle to be sure that nothing touched the leg: it was learnt from
  /// just now; valid until the next call. nullptr: nothing.
  const SeenFriction* learn(const WatchedMotion& motion, double unexplained_Nm, double noise_std_Nm,
                            double dt_s) noexcept;
  /// Something may touch the leg: what waits to be learnt is dropped.
  void freeze() noexcept;
  /// What is seen cannot be, as ground that pulls: the joint does not fit until motion has told more.
  void doubt() noexcept;

  bool fits() const noexcept { return reason_ == MisfitReason::kNone && !doubted_; }
  /// kNone while it is only doubted: motion has not told yet.
  MisfitReason reason() const noexcept { return reason_; }
  /// By how many of the stated standard deviations the model is off in the motion of late; 0 until enough
  /// was seen.
  double ratio() const noexcept { return ratio_; }

  /// What the model is believed to miss in this motion, torque that friction, inertia and torque constant
  /// take more than it says; and one standard deviation of that. Zero while it fits; of a foreign one never,
  /// for what was seen slow says little of quick motion.
  struct Missed {
    double torque_Nm = 0.0;
    double std_Nm = 0.0;
    /// Half-width at 95 % of an estimate that leaves it out.
    double bound_Nm() const noexcept;
  };
  Missed missed(const WatchedMotion& motion) const noexcept;
  /// The same where nothing touches the leg: what a contact is told from.
  Missed missed_if_free(const WatchedMotion& motion) const noexcept;

  enum Term : std::size_t { kDry, kViscous, kLoad, kInertia, kTorqueConstant, kWeight, kOutside, kTerms };
  using Terms = std::array<double, kTerms>;
  /// Best guess of c, b, k and the x, in the order of Term.
  const Terms& found() const noexcept { return found_; }

 private:
  using Matrix = std::array<Terms, kTerms>;
  /// Means over some samples of one motion.
  struct Bucket {
    Terms part{};
    double unexplained_Nm = 0.0;
    double noise_Nm2 = 0.0;
    double stated_Nm2 = 0.0;
    double time_s = 0.0;
    FrictionByLaw friction{};
    bool moves_itself = true;
    double excess_Nm = 0.0;  ///< friction beyond what was in force
    double other_Nm2 = 0.0;  ///< variance of that by all else
  };
  /// Means over a motion: of part times part, and of what robot.yaml states for it.
  struct Moment {
    Matrix parts{};
    double stated_Nm2 = 0.0;
  };
  Missed missed_of(const Terms& part, double adapted_Nm) const noexcept;
  double ratio_in(const Moment& motion) const noexcept;
  Terms parts(const WatchedMotion& motion) const noexcept;
  double stated_Nm2(const WatchedMotion& motion) const noexcept;
  double other_Nm2(const WatchedMotion& motion) const noexcept;
  void fill(const WatchedMotion& motion, double unexplained_Nm, double noise_std_Nm, double dt_s) noexcept;
  bool wait(const Bucket& bucket) noexcept;
  void age(double time_s) noexcept;
  void take(const Bucket& bucket) noexcept;
  void remember(const Bucket& bucket) noexcept;
  void judge() noexcept;
  MisfitReason likely_reason() const noexcept;

  JointUncertainty stated_;
  bool foreign_;
  Terms prior_{};  ///< one standard deviation of each
  Terms found_{};
  Matrix covariance_{};
  Moment moment_{};              ///< of late
  Moment worst_{};               ///< in which the misfit showed most
  double quickest_rad_s_ = 0.0;  ///< that was seen
  double seen_s_ = 0.0;          ///< of motion, counted to the length of the window; since a doubt
  Bucket filling_{};
  static constexpr std::size_t kWaiting = 8;
  std::array<Bucket, kWaiting> waiting_{};  ///< ring
  std::size_t next_ = 0, count_ = 0;
  SeenFriction seen_{};  ///< the last that was taken
  double ratio_ = 0.0;
  MisfitReason reason_ = MisfitReason::kNone;
  bool doubted_ = false;
};

}  // namespace sprung
