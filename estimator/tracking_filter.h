#pragma once
/// Position, velocity and acceleration of one joint from its encoder, by a Kalman filter with the motor's own
/// acceleration as known input. Pure, no heap; about a hundred multiplications a step.
///
///   model         qdd = input + unexplained,  d(unexplained)/dt = white noise
///   measurement   position + white noise
///
/// `input` is what the motor torque alone would do, (R Kt i - tau_f) / (R^2 I). The filter then only has to
/// track what the link does to the gear, which is small and slow beside the rotor's own acceleration
/// (docs/sources.md, facts E6, D6), so that the gear's output torque -R^2 I * unexplained comes without
/// differences and without the lag of an acceleration filter.
///
/// The covariance is propagated and not a steady state's: an encoder that is read at an uncertain instant is
/// worse the faster the joint moves, by a factor of 100 in a jump, and samples may be missing. So the filter
/// is quick on a slow joint and patient on a fast one, at any cycle rate, and knows how wrong it may be.

namespace sprung {

class TrackingFilter {
 public:
  /// @param density of the white noise that drives `unexplained`, (rad/s^2)^2 / s, > 0.
  explicit TrackingFilter(double density) noexcept : density_(density) {}

  /// At rest at this position. @param unexplained_std_rad_s2 how well `unexplained` is known.
  void start(double position_rad, double unexplained_rad_s2, double position_std_rad,
             double unexplained_std_rad_s2) noexcept;
  /// @param input_rad_s2 mean over the interval.
  void predict(double dt_s, double input_rad_s2) noexcept;
  /// @param std_rad of the measurement.
  void correct(double measured_position_rad, double std_rad) noexcept;

  double position_rad() const noexcept { return x_[0]; }
  double velocity_rad_s() const noexcept { return x_[1]; }
  double unexplained_rad_s2() const noexcept { return x_[2]; }
  double position_std_rad() const noexcept;
  double velocity_std_rad_s() const noexcept;
  double unexplained_std_rad_s2() const noexcept;
  /// By how much the last correction moved `unexplained`: large while something happens that the model did
  /// not expect.
  double unexplained_step_rad_s2() const noexcept { return step_rad_s2_; }

 private:
  double density_;
  double x_[3] = {};
  /// Covariance, symmetric: position, position-velocity, position-unexplained, velocity,
  /// velocity-unexplained, unexplained.
  double p_[6] = {};
  double step_rad_s2_ = 0.0;
};

}  // namespace sprung
