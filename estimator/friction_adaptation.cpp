#include "estimator/friction_adaptation.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

/// Of the stated uncertainty, what no factor is: ripple with position, load, hysteresis (facts D1, D3, D10).
constexpr double kNoFactor = 0.4;
/// Correlation of the two before anything was learnt: wear changes both, warmth the viscous part.
constexpr double kTogether = 0.5;
/// Errors of everything else stay the same for a swing.
constexpr double kSwing_s = 0.3;
/// A gear's warmth (facts D2).
constexpr double kForgetsFriction_s = 600.0;
constexpr double kMostOfUncertainty = 2.0;
constexpr double kLeastFactor = 0.1;
/// Friction that differs by more is something that touches the leg. A hand is there for a swing and more.
constexpr double kMostFrictionStds = 3.0;

}  // namespace

FrictionAdaptation::FrictionAdaptation(double uncertainty, bool learns) noexcept
    : uncertainty_(uncertainty), learns_(learns) {
  prior_ = (1.0 - kNoFactor * kNoFactor) * uncertainty * uncertainty;
  prior_both_ = kTogether * prior_;
  dry_ = viscous_ = prior_;
  both_ = prior_both_;
}

void FrictionAdaptation::age(double dt_s) noexcept {
  if (!learns_) return;
  const double lost = std::min(1.0, dt_s / kForgetsFriction_s);
  factors_.dry += lost * (1.0 - factors_.dry);
  factors_.viscous += lost * (1.0 - factors_.viscous);
  const double back = std::min(1.0, 2.0 * lost);
  dry_ += back * (prior_ - dry_);
  viscous_ += back * (prior_ - viscous_);
  both_ += back * (prior_both_ - both_);
}

double FrictionAdaptation::variance_Nm2(const FrictionByLaw& law) const noexcept {
  return dry_ * law.dry_Nm * law.dry_Nm + viscous_ * law.viscous_Nm * law.viscous_Nm +
         2.0 * both_ * law.dry_Nm * law.viscous_Nm;
}

void FrictionAdaptation::move(double& factor, double by) const noexcept {
  const double most = kMostOfUncertainty * uncertainty_;
  factor = std::clamp(factor + by, std::max(kLeastFactor, 1.0 - most), 1.0 + most);
}

bool FrictionAdaptation::touched(const SeenFriction& seen) noexcept {
  const double once_Nm2 = variance_Nm2(seen.law) + seen.other_std_Nm * seen.other_std_Nm;
  if (!(once_Nm2 > 0.0)) return true;
  if (seen.excess_Nm * seen.excess_Nm > kMostFrictionStds * kMostFrictionStds * once_Nm2)
    touched_s_ = kSwing_s;
  else
    touched_s_ = std::max(0.0, touched_s_ - seen.time_s);
  return touched_s_ > 0.0;
}

void FrictionAdaptation::learn(const SeenFriction& seen) noexcept {
  if (!learns_ || !std::isfinite(seen.excess_Nm) || !(seen.time_s > 0.0)) return;
  if (touched(seen) || !seen.moves_itself) return;
  const double known_Nm2 = variance_Nm2(seen.law);
  const double total_Nm2 = known_Nm2 +
                           std::max(1.0, kSwing_s / seen.time_s) * seen.other_std_Nm * seen.other_std_Nm;
  const double dry = dry_ * seen.law.dry_Nm + both_ * seen.law.viscous_Nm;
  const double viscous = both_ * seen.law.dry_Nm + viscous_ * seen.law.viscous_Nm;
  move(factors_.dry, dry / total_Nm2 * seen.excess_Nm);
  move(factors_.viscous, viscous / total_Nm2 * seen.excess_Nm);
  dry_ -= dry * dry / total_Nm2;
  both_ -= dry * viscous / total_Nm2;
  viscous_ -= viscous * viscous / total_Nm2;
}

double FrictionAdaptation::std_Nm(const FrictionByLaw& law) const noexcept {
  const double stated_Nm = uncertainty_ * std::abs(law.torque_Nm(factors_));
  if (!learns_) return stated_Nm;
  return std::min(stated_Nm, std::hypot(kNoFactor * stated_Nm, std::sqrt(std::max(0.0, variance_Nm2(law)))));
}

}  // namespace sprung
