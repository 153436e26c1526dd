#include "estimator/contact_detector.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace sprung {
namespace {

/// What is wrong with the model is bounded (friction within 25 %, say, is 1.7 of its standard deviations):
/// this many are enough, since most of it was learnt in the swing or lies in several joints at once.
constexpr double kForceModelStds = 3.5;
/// Noise is new in every sample: with some 10^2 independent ones in a swing, 4.5 standard deviations are
/// passed in one of 3000 swings, and must last for the rise time besides.
constexpr double kForceNoiseStds = 4.5;
/// A stuck gear holds any torque up to its half-width, sqrt 3 standard deviations, of both signs when it just
/// reverses.
constexpr double kRestStds = 2.0;
/// Lift-off: a force of this many standard deviations may be none.
constexpr double kGoneStds = 2.0;
/// The last of a thrust's force, which errors explain already, is no swing to learn from.
constexpr double kTakeOff_s = 0.03;

bool finite(const std::vector<ContactEvidence>& evidence) noexcept {
  return std::all_of(evidence.begin(), evidence.end(), [](const ContactEvidence& joint) {
    double sum = joint.residual.torque_Nm + joint.residual.unknown_friction_Nm + joint.lever_m +
                 joint.tangential_lever_m[0] + joint.tangential_lever_m[1];
    for (const double part_Nm : joint.residual.part_Nm) sum += part_Nm;
    return std::isfinite(sum);
  });
}

double variance_Nm2(const ResidualModel& joint) noexcept {
  constexpr double kLeast_Nm2 = 1e-12;  // a joint without any error would be all that counts
  return joint.model_Nm2() + joint.noise_Nm2() + joint.rest_Nm2() + kLeast_Nm2;
}

}  // namespace

ContactDetector::ContactDetector(const ContactParams& params, std::vector<ResidualModel> joints)
    : params_(params), joints_(std::move(joints)) {
  if (!(params.on_N > params.off_N)) throw std::invalid_argument("contact: 'on' must be above 'off'");
  if (!(params.rise_s >= 0.0 && params.fall_s >= 0.0)) {
    throw std::invalid_argument("contact: delays must not be negative");
  }
  if (!(params.tangential_N >= 0.0)) {
    throw std::invalid_argument("contact: the tangential force must not be negative");
  }
}

void ContactDetector::reset() noexcept {
  contact_ = false;
  beyond_s_ = free_s_ = 0.0;
  for (ResidualModel& joint : joints_) joint.reset();
}

bool ContactDetector::surely_free() const noexcept { return free_s_ > kTakeOff_s; }

ContactEstimate ContactDetector::step(const std::vector<ContactEvidence>& evidence, double dt_s) noexcept {
  if (evidence.size() != joints_.size() || !finite(evidence)) {
    reset();
    return {};
  }
  free_s_ = contact_ ? 0.0 : free_s_ + dt_s;
  for (std::size_t j = 0; j < joints_.size(); ++j) joints_[j].step(evidence[j].residual, dt_s, surely_free());
  const Force now = force(evidence);
  decide(now, dt_s);
  const double middle_N = 0.5 * (params_.on_N + params_.off_N);
  const double std_N = std::sqrt(now.model_N2 + now.noise_N2 + now.rest_N2);
  const double spread_N = std::max(0.5 * (params_.on_N - params_.off_N), 2.0 * std_N);
  return {contact_, 0.5 * (1.0 + std::tanh((now.value_N - middle_N) / spread_N)), now.value_N, std_N};
}

std::array<double, 2> ContactDetector::tangential_look_alike(
    const std::vector<ContactEvidence>& evidence) const noexcept {
  if (params_.tangential_N == 0.0) return {};
  Eigen::Matrix2d information = Eigen::Matrix2d::Identity() / (params_.tangential_N * params_.tangential_N);
  Eigen::Vector2d shared = Eigen::Vector2d::Zero();
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const Eigen::Vector2d lever_m(evidence[j].tangential_lever_m[0], evidence[j].tangential_lever_m[1]);
    const Eigen::Vector2d weight = lever_m / variance_Nm2(joints_[j]);
    information += weight * lever_m.transpose();
    shared += weight * evidence[j].lever_m;
  }
  const Eigen::Vector2d alike = information.inverse() * shared;
  return {alike.x(), alike.y()};
}

ContactDetector::Force ContactDetector::force(const std::vector<ContactEvidence>& evidence) const noexcept {
  const std::array<double, 2> alike = tangential_look_alike(evidence);
  double information = 0.0;
  Force sum;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const ResidualModel& joint = joints_[j];
    const ContactEvidence& seen = evidence[j];
    const double own_lever_m = seen.lever_m - (alike[0] * seen.tangential_lever_m[0] +
                                               alike[1] * seen.tangential_lever_m[1]);
    const double weight = own_lever_m / variance_Nm2(joint);
    information += weight * seen.lever_m;
    sum.value_N += weight * joint.torque_Nm();
    sum.model_N2 += weight * weight * joint.model_Nm2();
    sum.noise_N2 += weight * weight * joint.noise_Nm2();
    sum.rest_N2 += weight * weight * joint.rest_Nm2();
  }
  if (!(information > 0.0)) return {0.0, 0.0, 0.0, HUGE_VAL};  // no joint feels a vertical force
  sum.value_N /= information;
  for (double* variance : {&sum.model_N2, &sum.noise_N2, &sum.rest_N2})
    *variance /= information * information;
  return sum;
}

double ContactDetector::least_rise_N(const Force& force) const noexcept {
  const double error_N = std::sqrt(kForceModelStds * kForceModelStds * force.model_N2 +
                                   kForceNoiseStds * kForceNoiseStds * force.noise_N2);
  return std::max(params_.on_N, error_N + kRestStds * std::sqrt(force.rest_N2));
}

/// A force that errors explain is lost: a thrust ends in a deceleration whose errors are large, and to wait
/// for certainty would report lift-off late. But a joint at rest may hold any load by friction, and says
/// nothing.
double ContactDetector::least_hold_N(const Force& force) const noexcept {
  const double error_N = kGoneStds * std::sqrt(force.model_N2 + force.noise_N2);
  return std::max(params_.off_N, error_N) - std::sqrt(force.rest_N2);
}

void ContactDetector::decide(const Force& force, double dt_s) noexcept {
  const bool beyond = contact_ ? force.value_N < least_hold_N(force) : force.value_N > least_rise_N(force);
  const double delay_s = contact_ ? params_.fall_s : params_.rise_s;
  constexpr double kRounding_s = 1e-9;  // message times are whole microseconds
  // The sample that crosses starts the clock, so that a delay of n cycles takes n more samples.
  if (beyond && beyond_s_ + kRounding_s >= delay_s) {
    contact_ = !contact_;
    beyond_s_ = 0.0;
  } else {
    // Contact is lost through noise, which crosses the threshold now and then, and found by an even force.
    const double back_s = contact_ ? std::max(0.0, beyond_s_ - dt_s) : 0.0;
    beyond_s_ = beyond ? beyond_s_ + dt_s : back_s;
  }
}

}  // namespace sprung
