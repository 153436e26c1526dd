#pragma once
/// Position, velocity and acceleration of one joint from its encoder, by a steady-state Kalman filter with
/// the motor's own acceleration as known input. Pure: the gains are solved once, a step is a dozen
/// multiplications.
///
///   model   qdd = input + unexplained,  d(unexplained)/dt = white noise,  measurement = position + white
///   noise
///
/// `input` is what the motor torque alone would do, (R Kt i - tau_f) / (R^2 I). The filter then only has to
/// track what the link does to the gear, which is small and slow beside the rotor's own acceleration (facts
/// E6, D6), so that the gear's output torque -R^2 I * unexplained comes without differences and without the
/// lag of an acceleration filter.
namespace sprung {

struct TrackingGains {
  double position = 0.0;  ///< of the innovation, dimensionless
  double velocity_1_s = 0.0;
  double acceleration_1_s2 = 0.0;
  double acceleration_std_1_s2 = 0.0;  ///< std of `unexplained` for each unit of measurement std
};

struct TrackingState {
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;
  double unexplained_rad_s2 = 0.0;
};

/// Steady state of the Riccati recursion, with process noise chosen so that the continuous filter's three
/// poles lie on a circle of radius `bandwidth_rad_s` (Butterworth): noise density q = bandwidth^6 * R * dt.
/// @throws std::invalid_argument unless 0 < bandwidth * dt < 3, beyond which the filter only differentiates.
TrackingGains solve_tracking_gains(double dt_s, double bandwidth_rad_s);

/// @param input_rad_s2 mean over the interval.
void predict(TrackingState& state, double dt_s, double input_rad_s2) noexcept;
void correct(TrackingState& state, const TrackingGains& gains, double measured_position_rad) noexcept;

}  // namespace sprung
