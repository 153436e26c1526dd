#include "planner/height_law.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

// height_share = kSquare s^2 + kLinear s + kConstant, 1 at s = 1.
constexpr double kSquare = 1.172;
constexpr double kLinear = -0.738;
constexpr double kConstant = 1.0 - kSquare - kLinear;

}  // namespace

double height_share(double amplitude) noexcept {
  return (kSquare * amplitude + kLinear) * amplitude + kConstant;
}

double amplitude_for(double share) noexcept {
  const double least = height_share(kLeastAmplitude);
  if (share <= least) return kLeastAmplitude;
  const double root = std::sqrt(kLinear * kLinear - 4.0 * kSquare * (kConstant - share));
  return (root - kLinear) / (2.0 * kSquare);
}

void HeightAdaptation::learn(JumpMode mode, double asked_m, double estimated_m) noexcept {
  if (!learns_ || !(asked_m > 0.0) || !(estimated_m > 0.0)) return;
  const double change = std::clamp(asked_m / estimated_m, 1.0 / kMostChange, kMostChange);
  double& factor = factors_[index(mode)];
  factor = std::clamp(factor * change, kLeastFactor, kMostFactor);
}

}  // namespace sprung
