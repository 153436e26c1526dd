#include "estimator/residual_model.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

/// Friction drifts with temperature and load; a swing lasts 0.3 s and more.
constexpr double kMemory_s = 2.0;
/// Samples of the residual are alike for as long as the motion filter remembers, 3 ms, and as what the model
/// does not know of (the gear's hysteresis, a foot that still drags) lasts: so much less does each of them
/// say.
constexpr double kCorrelation_s = 10e-3;
/// The noise follows what the swing shows.
constexpr double kNoiseTime_s = 0.1;
/// A residual beyond this many standard deviations is something else than noise and counts as this many.
constexpr double kClip = 2.0;
/// What is wrong with a joint is bounded: else a slow force, long enough, would be learnt whole. In standard
/// deviations; and noise as a multiple of what is expected at first.
constexpr double kMostShare = 2.5;
constexpr double kMostNoise = 3;
/// After a reversal the motion filter still carries the step of friction: its longest pole is 1.3 ms.
constexpr double kReversalTime_s = 4e-3;
/// Contact that is not found within this time may be learnt as an error; the slowest touchdown should take 20
/// ms.
constexpr double kLearning_delay_s = 0.025;
constexpr double kHalfWidthStd = 0.5773502691896258;  // of a half-width: 1 / sqrt 3

}  // namespace

ResidualModel::ResidualModel(const ErrorShares& prior, double noise_Nm, double cycle_s)
    : prior_(prior),
      first_noise_Nm_(noise_Nm),
      waiting_(static_cast<std::size_t>(std::max(1.0, std::round(kLearning_delay_s / cycle_s)))) {
  reset();
}

void ResidualModel::reset() noexcept {
  share_ = {};
  covariance_ = {};
  for (std::size_t i = 0; i < kErrorSources; ++i) covariance_[i][i] = prior_[i] * prior_[i];
  noise_Nm2_ = first_noise_Nm_ * first_noise_Nm_;
  rest_Nm_ = torque_Nm_ = model_Nm2_ = 0.0;
  count_ = 0;
}

void ResidualModel::step(const JointResidual& in, double dt_s, bool free) noexcept {
  if (dt_s != decay_.dt_s) decay_ = decay(dt_s);
  age();
  rest_Nm_ = std::max(kHalfWidthStd * in.unknown_friction_Nm, rest_Nm_ * decay_.reversal);
  torque_Nm_ = in.torque_Nm - error_Nm(in.part_Nm);
  model_Nm2_ = error_Nm2(in.part_Nm) + in.misfit_Nm2;
  if (free) {
    wait(in, dt_s);
  } else {
    count_ = 0;
  }
}

void ResidualModel::wait(const JointResidual& in, double dt_s) noexcept {
  if (count_ == waiting_.size()) {
    learn(waiting_[next_], dt_s);
  } else {
    ++count_;
  }
  waiting_[next_] = {in, rest_Nm_ * rest_Nm_};
  next_ = (next_ + 1) % waiting_.size();
}

double ResidualModel::error_Nm(const ErrorShares& part_Nm) const noexcept {
  double sum_Nm = 0.0;
  for (std::size_t i = 0; i < kErrorSources; ++i) sum_Nm += share_[i] * part_Nm[i];
  return sum_Nm;
}

double ResidualModel::error_Nm2(const ErrorShares& part_Nm) const noexcept {
  double sum_Nm2 = 0.0;
  for (std::size_t i = 0; i < kErrorSources; ++i) {
    for (std::size_t k = 0; k < kErrorSources; ++k) sum_Nm2 += part_Nm[i] * covariance_[i][k] * part_Nm[k];
  }
  return sum_Nm2;
}

ResidualModel::Decay ResidualModel::decay(double dt_s) noexcept {
  return {dt_s, std::exp(-dt_s / kMemory_s), std::exp(-dt_s / kReversalTime_s)};
}

/// d(share)/dt = -share / memory + white noise that keeps the prior.
void ResidualModel::age() noexcept {
  const double kept_squared = decay_.shares * decay_.shares;
  for (std::size_t i = 0; i < kErrorSources; ++i) {
    share_[i] *= decay_.shares;
    for (std::size_t k = 0; k < kErrorSources; ++k) covariance_[i][k] *= kept_squared;
    covariance_[i][i] += (1.0 - kept_squared) * prior_[i] * prior_[i];
  }
}

void ResidualModel::learn(const Sample& sample, double dt_s) noexcept {
  if (sample.rest_Nm2 > noise_Nm2_) return;  // a joint at rest may hold any load
  const ErrorShares& part_Nm = sample.residual.part_Nm;
  const double explained_Nm2 = error_Nm2(part_Nm) + sample.residual.misfit_Nm2 + sample.rest_Nm2;
  const double most_Nm = kClip * std::sqrt(explained_Nm2 + noise_Nm2_);
  const double left_Nm = std::clamp(sample.residual.torque_Nm - error_Nm(part_Nm), -most_Nm, most_Nm);
  const double alike = std::max(1.0, 2.0 * kCorrelation_s / dt_s);
  const double total_Nm2 = error_Nm2(part_Nm) + alike * (noise_Nm2_ + sample.rest_Nm2);
  if (!(total_Nm2 > 0.0)) return;  // nothing acts, and nothing is unknown
  ErrorShares gain{};
  for (std::size_t i = 0; i < kErrorSources; ++i) {
    for (std::size_t k = 0; k < kErrorSources; ++k) gain[i] += covariance_[i][k] * part_Nm[k];
  }
  for (std::size_t i = 0; i < kErrorSources; ++i) {
    share_[i] = std::clamp(share_[i] + gain[i] / total_Nm2 * left_Nm, -kMostShare * prior_[i],
                           kMostShare * prior_[i]);
    for (std::size_t k = 0; k < kErrorSources; ++k) covariance_[i][k] -= gain[i] * gain[k] / total_Nm2;
  }
  const double noise_Nm2 = std::max(0.0, left_Nm * left_Nm - explained_Nm2);
  const double most_noise_Nm = kMostNoise * first_noise_Nm_;
  noise_Nm2_ = std::min(noise_Nm2_ + dt_s / kNoiseTime_s * (noise_Nm2 - noise_Nm2_),
                        most_noise_Nm * most_noise_Nm);
}

}  // namespace sprung
