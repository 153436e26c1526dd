#pragma once
/// What is wrong with one joint's external torque while nothing touches its leg, learnt from the swing
/// itself. Pure: no heap, never throws.
///
/// The estimate is wrong in known directions: friction, rotor inertia, motor torque and the leg's weight are
/// each off by an unknown share x_i of themselves, error = sum x_i part_i + noise. A Kalman filter with the
/// shares as state (first-order Markov, back to their prior within kMemory_s) learns them where the foot is
/// free. Its prediction is taken off the estimate; its variance says what the estimate is worth now. A share
/// that the swing did not show (acceleration in a steady descent) stays as uncertain as it was. What is
/// learnt is kLearning_delay_s old: a contact that is found within that time has taught nothing.
#include <array>
#include <cstddef>
#include <vector>

namespace sprung {

/// Where the error comes from, in order of the arrays below.
enum ErrorSource { kFrictionError, kInertiaError, kMotorError, kWeightError, kErrorSources };
using ErrorShares = std::array<double, kErrorSources>;

struct JointResidual {
  double torque_Nm = 0.0;            ///< external torque as estimated
  ErrorShares part_Nm{};             ///< friction, armature * acceleration, motor torque, weight: signed
  double unknown_friction_Nm = 0.0;  ///< half-width of what friction may be besides: its sign is not known at
                                     ///< rest
  double misfit_Nm2 = 0.0;           ///< variance besides: the model is known not to fit (model_watch.h)
};

class ResidualModel {
 public:
  /// @param prior one standard deviation of each share.
  /// @param noise_Nm expected at first; then as the swing shows.
  ResidualModel(const ErrorShares& prior, double noise_Nm, double cycle_s);

  void reset() noexcept;
  /// Sets what the functions below return. @param free the foot is: learn from it.
  void step(const JointResidual& in, double dt_s, bool free) noexcept;

  double torque_Nm() const noexcept { return torque_Nm_; }  ///< external, error taken off
  /// What of it is still wrong: variances of the shares' error, of the noise, and of friction near rest.
  double model_Nm2() const noexcept { return model_Nm2_; }
  double noise_Nm2() const noexcept { return noise_Nm2_; }
  double rest_Nm2() const noexcept { return rest_Nm_ * rest_Nm_; }

 private:
  struct Sample {
    JointResidual residual;
    double rest_Nm2 = 0.0;
  };
  /// Of what is there, the shares that are left after dt_s.
  struct Decay {
    double dt_s = 0.0;
    double shares = 1.0;
    double reversal = 1.0;
  };
  static Decay decay(double dt_s) noexcept;
  void age() noexcept;
  void wait(const JointResidual& in, double dt_s) noexcept;
  void learn(const Sample& sample, double dt_s) noexcept;
  double error_Nm(const ErrorShares& part_Nm) const noexcept;
  double error_Nm2(const ErrorShares& part_Nm) const noexcept;

  ErrorShares prior_;
  Decay decay_;  ///< of the last step: cycles are alike, and need no exponentials anew
  double first_noise_Nm_;
  ErrorShares share_{};
  std::array<ErrorShares, kErrorSources> covariance_{};
  double noise_Nm2_ = 0.0;
  double rest_Nm_ = 0.0;
  double torque_Nm_ = 0.0;
  std::vector<Sample> waiting_;  ///< ring of fixed size
  std::size_t next_ = 0;         ///< where the oldest is, and the newest comes
  std::size_t count_ = 0;
  double model_Nm2_ = 0.0;
};

}  // namespace sprung
