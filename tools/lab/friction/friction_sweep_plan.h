#pragma once
/// Which constant speeds a friction sweep drives, and which of its samples count. Pure.
#include <vector>

#include "signals/enumeration.h"

namespace sprung {

struct BenchLimits;

/// R^2 of a friction fit depends on the protocol as much as on the joint (facts papers C4), so it is named
/// with it.
enum class SweepProtocol {
  kS0,      ///< S0 Fig. 5: a few speeds, both directions, repeated; motor torque averaged over both
  kS1,      ///< S1 Fig. 9 as C4 reads it: speeds uniform in 0.02-4 rad/s, no load, single samples of one
            ///< direction
  kLoaded,  ///< slow and fast in both directions under constant outside torques, so that the gear drives and
            ///< is driven back
};
constexpr auto words_of(SweepProtocol) {
  return words<SweepProtocol>(
      {{SweepProtocol::kS0, "s0"}, {SweepProtocol::kS1, "s1"}, {SweepProtocol::kLoaded, "loaded"}});
}

/// One way at one constant speed, there or back.
struct SweepPass {
  double from_rad = 0.0;
  double to_rad = 0.0;
  double speed_rad_s = 0.0;  ///< magnitude
  double acceleration_rad_s2 = 0.0;
  double load_Nm = 0.0;   ///< outside torque
  bool held_out = false;  ///< for scoring alone: every second of the load's and speed's checkerboard
  double direction() const { return to_rad > from_rad ? 1.0 : -1.0; }
};

struct SweepPlan {
  std::vector<SweepPass> passes;   ///< in order; there and back alternate
  std::size_t samples_a_pass = 0;  ///< evenly out of the constant speed; the same for each, so that no speed
                                   ///< weighs more
  bool mirrored = false;           ///< see steady_span()
};

/// Passes lie around the middle of the joint's range. @throws std::invalid_argument where the range is too
/// short for the speeds.
SweepPlan sweep_plan(SweepProtocol protocol, const BenchLimits& limits);

/// Of a pass that began at 0 s: from when the position loop has settled to when braking begins.
struct SteadySpan {
  double from_s = 0.0;
  double to_s = 0.0;
};
/// @param mirrored the end is cut off as the beginning is, so that there and back see the same angles and a
/// weight drops out of the mean of both.
SteadySpan steady_span(const SweepPass& pass, bool mirrored);

/// Indices of `wanted` of `count` samples, evenly spread; all where there are no more.
std::vector<std::size_t> evenly_picked(std::size_t count, std::size_t wanted);

}  // namespace sprung
