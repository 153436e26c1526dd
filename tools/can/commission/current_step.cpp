#include "tools/can/commission/current_step.h"

#include <cmath>
#include <limits>

namespace sprung::commission {
namespace {

constexpr double kEarlyFrom_s = 0.003, kEarlyTo_s = 0.008, kSettledFrom_s = 0.020;
constexpr double kEarlyShare = 0.75;  ///< of the set-point; a loop of 50 Hz has 81 % then, one of 25 Hz 55 %
constexpr double kSettledError = 0.15;  ///< of the set-point
constexpr double kRipple = 0.15;        ///< of the set-point, beside the sensor's own noise
constexpr double kNoise = 3.0;          ///< times its rms

struct Spread {
  double mean = 0.0, rms = 0.0;
  int count = 0;
};

Spread spread(const std::vector<CurrentSample>& samples, double from_s, double to_s) {
  Spread out;
  double squares = 0.0;
  for (const CurrentSample& sample : samples) {
    if (sample.time_s < from_s || sample.time_s > to_s) continue;
    ++out.count;
    out.mean += sample.current_A;
    squares += sample.current_A * sample.current_A;
  }
  if (out.count == 0) return out;
  out.mean /= out.count;
  out.rms = std::sqrt(std::max(0.0, squares / out.count - out.mean * out.mean));
  return out;
}

}  // namespace

CurrentStepResult judge_current_step(const std::vector<CurrentSample>& before,
                                     const std::vector<CurrentSample>& after, double target_A) {
  constexpr double kEver = std::numeric_limits<double>::infinity();
  const Spread noise = spread(before, -kEver, kEver);
  const Spread early = spread(after, kEarlyFrom_s, kEarlyTo_s);
  const Spread settled = spread(after, kSettledFrom_s, kEver);
  CurrentStepResult out{CurrentLoopVerdict::kFollows, early.mean, settled.mean, settled.rms};
  const double size_A = std::abs(target_A);
  const auto of_mean_A = [&](const Spread& part) {
    return kNoise * noise.rms / std::sqrt(std::max(1, part.count));
  };
  if (settled.rms > kNoise * noise.rms + kRipple * size_A) {
    out.verdict = CurrentLoopVerdict::kOscillates;
  } else if (std::abs(settled.mean) < 0.1 * size_A + of_mean_A(settled)) {
    out.verdict = CurrentLoopVerdict::kNothing;
  } else if (early.mean * (target_A > 0 ? 1 : -1) < kEarlyShare * size_A - of_mean_A(early)) {
    out.verdict = CurrentLoopVerdict::kSluggish;
  } else if (std::abs(settled.mean - target_A) > kSettledError * size_A + of_mean_A(settled)) {
    out.verdict = CurrentLoopVerdict::kElsewhere;
  }
  return out;
}

}  // namespace sprung::commission
