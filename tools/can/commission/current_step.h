#pragma once
/// Whether a current loop is tuned for its motor: a small step at standstill, and what was measured. Pure.
#include <vector>

#include "signals/enumeration.h"

namespace sprung::commission {

struct CurrentSample {
  double time_s = 0.0;  ///< since the step
  double current_A = 0.0;
};

enum class CurrentLoopVerdict : std::int8_t { kFollows, kSluggish, kOscillates, kElsewhere, kNothing };
constexpr auto words_of(CurrentLoopVerdict) {
  using E = CurrentLoopVerdict;
  return words<E>({{E::kFollows, "follows"},
                   {E::kSluggish, "sluggish"},
                   {E::kOscillates, "oscillates"},
                   {E::kElsewhere, "settles elsewhere"},
                   {E::kNothing, "no current flows"}});
}

struct CurrentStepResult {
  CurrentLoopVerdict verdict = CurrentLoopVerdict::kNothing;
  double early_A = 0.0;    ///< mean from 3 to 8 ms
  double settled_A = 0.0;  ///< mean from 20 ms on
  double ripple_A = 0.0;   ///< rms about that
};

/// @param before without current: its scatter is the sensor's. @param after the step to `target_A`, 60 ms of
/// it; several steps one after the other may be in it.
CurrentStepResult judge_current_step(const std::vector<CurrentSample>& before,
                                     const std::vector<CurrentSample>& after, double target_A);

}  // namespace sprung::commission
