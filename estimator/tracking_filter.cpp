#include "estimator/tracking_filter.h"

#include <Eigen/Core>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace sprung {
namespace {

Eigen::Matrix3d transition(double dt) {
  Eigen::Matrix3d f;
  f << 1.0, dt, dt * dt / 2.0, 0.0, 1.0, dt, 0.0, 0.0, 1.0;
  return f;
}

/// Covariance that white noise of unit density on the third derivative adds in dt.
Eigen::Matrix3d jerk_noise(double dt) {
  const double d2 = dt * dt;
  const double d3 = d2 * dt;
  Eigen::Matrix3d q;
  q << d3 * d2 / 20.0, d2 * d2 / 8.0, d3 / 6.0,  //
      d2 * d2 / 8.0, d3 / 3.0, d2 / 2.0,         //
      d3 / 6.0, d2 / 2.0, dt;
  return q;
}

std::string too_slow(double dt_s, double bandwidth_rad_s) {
  const double least_Hz = bandwidth_rad_s / 3.0;
  char text[200];
  std::snprintf(text, sizeof text,
                "robot.yaml: key 'cycle_rate': found %g Hz, expected more than %.1f Hz, below which the "
                "estimator cannot "
                "follow a joint: raise it",
                1.0 / dt_s, least_Hz);
  return text;
}

}  // namespace

TrackingGains solve_tracking_gains(double dt_s, double bandwidth_rad_s) {
  const double x = dt_s * bandwidth_rad_s;
  if (!(x > 0.0 && x < 3.0)) throw std::invalid_argument(too_slow(dt_s, bandwidth_rad_s));
  // In units of the sample time and of the measurement noise, so that the recursion is well scaled for any
  // robot.
  const Eigen::Matrix3d f = transition(1.0);
  const Eigen::Matrix3d q = std::pow(x, 6.0) * jerk_noise(1.0);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();
  Eigen::Vector3d gain = Eigen::Vector3d::Zero();
  constexpr int kMostSteps = 200000;
  for (int i = 0; i < kMostSteps; ++i) {
    const Eigen::Matrix3d predicted = f * covariance * f.transpose() + q;
    const Eigen::Vector3d next = predicted.col(0) / (predicted(0, 0) + 1.0);
    covariance = predicted - next * predicted.row(0);
    const bool settled = (next - gain).norm() < 1e-14 * next.norm();
    gain = next;
    if (settled) break;
  }
  const double rate = 1.0 / dt_s;
  return {gain[0], gain[1] * rate, gain[2] * rate * rate, std::sqrt(covariance(2, 2)) * rate * rate};
}

void predict(TrackingState& state, double dt_s, double input_rad_s2) noexcept {
  const double acceleration = input_rad_s2 + state.unexplained_rad_s2;
  state.position_rad += dt_s * (state.velocity_rad_s + 0.5 * dt_s * acceleration);
  state.velocity_rad_s += dt_s * acceleration;
}

void correct(TrackingState& state, const TrackingGains& gains, double measured_position_rad) noexcept {
  const double innovation = measured_position_rad - state.position_rad;
  state.position_rad += gains.position * innovation;
  state.velocity_rad_s += gains.velocity_1_s * innovation;
  state.unexplained_rad_s2 += gains.acceleration_1_s2 * innovation;
}

}  // namespace sprung
