#include "estimator/tracking_filter.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sprung {
namespace {

enum : int { kPP, kPV, kPU, kVV, kVU, kUU };

double root(double variance) noexcept { return std::sqrt(std::max(0.0, variance)); }

}  // namespace

void TrackingFilter::start(double position_rad, double unexplained_rad_s2, double position_std_rad,
                           double unexplained_std_rad_s2) noexcept {
  x_[0] = position_rad;
  x_[1] = 0.0;
  x_[2] = unexplained_rad_s2;
  std::fill(std::begin(p_), std::end(p_), 0.0);
  p_[kPP] = position_std_rad * position_std_rad;
  p_[kUU] = unexplained_std_rad_s2 * unexplained_std_rad_s2;
  step_rad_s2_ = 0.0;
}

void TrackingFilter::predict(double dt_s, double input_rad_s2) noexcept {
  const double dt = dt_s, half = 0.5 * dt * dt;
  const double acceleration = input_rad_s2 + x_[2];
  x_[0] += dt * x_[1] + half * acceleration;
  x_[1] += dt * acceleration;
  // F P F' for F = [1 dt dt^2/2; 0 1 dt; 0 0 1]: first the rows of F P, then its columns.
  const double pv = p_[kPV] + dt * p_[kVV] + half * p_[kVU];
  const double pu = p_[kPU] + dt * p_[kVU] + half * p_[kUU];
  const double pp = p_[kPP] + dt * p_[kPV] + half * p_[kPU];
  const double vu = p_[kVU] + dt * p_[kUU];
  const double vv = p_[kVV] + dt * p_[kVU];
  const double d2 = dt * dt, d3 = d2 * dt;
  p_[kPP] = pp + dt * pv + half * pu + density_ * d3 * d2 / 20.0;
  p_[kPV] = pv + dt * pu + density_ * d2 * d2 / 8.0;
  p_[kPU] = pu + density_ * d3 / 6.0;
  p_[kVV] = vv + dt * vu + density_ * d3 / 3.0;
  p_[kVU] = vu + density_ * d2 / 2.0;
  p_[kUU] += density_ * dt;
}

void TrackingFilter::correct(double measured_position_rad, double std_rad) noexcept {
  const double share = 1.0 / (p_[kPP] + std_rad * std_rad);
  const double innovation = measured_position_rad - x_[0];
  const double pp = p_[kPP], pv = p_[kPV], pu = p_[kPU];
  x_[0] += share * pp * innovation;
  x_[1] += share * pv * innovation;
  step_rad_s2_ = share * pu * innovation;
  x_[2] += step_rad_s2_;
  p_[kPP] -= share * pp * pp;
  p_[kPV] -= share * pp * pv;
  p_[kPU] -= share * pp * pu;
  p_[kVV] -= share * pv * pv;
  p_[kVU] -= share * pv * pu;
  p_[kUU] -= share * pu * pu;
}

double TrackingFilter::position_std_rad() const noexcept { return root(p_[kPP]); }
double TrackingFilter::velocity_std_rad_s() const noexcept { return root(p_[kVV]); }
double TrackingFilter::unexplained_std_rad_s2() const noexcept { return root(p_[kUU]); }

}  // namespace sprung
