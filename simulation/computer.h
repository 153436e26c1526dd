#pragma once
/// How long the computer takes from the drives' answers to its set-points, and the cycles that it misses:
/// drawn from (seed, cycle) alone, so that every clock draws the same.
#include <cstdint>

#include "simulation/plant/drive_truth.h"

namespace sprung::sim {

class Computer {
 public:
  Computer(const TimingConfig& timing, std::uint64_t seed) noexcept;

  /// compute_time and what comes on top: 3 tail (u^-1/4 - 1), u uniform in (0, 1): mean `tail`, and longer
  /// than x in (1 + x / (3 tail))^-4 of the cycles (Pareto's law of the second kind; the shape is [D]: with
  /// 50 us, 1.5 ms come once in 15000 cycles).
  /// @param cycle since which it computes; before cycle 0 the tail is left out.
  std::int64_t compute_us(std::int64_t cycle) const noexcept;
  /// Whether no set-point of this cycle reaches the bus.
  bool misses(std::int64_t cycle) const noexcept;
  /// Set-points may come after the next SYNC, so that they act a cycle later; else they come with it at last.
  bool may_be_late(std::int64_t cycle) const noexcept { return tail_us_ > 0.0 && cycle >= 0; }

 private:
  double uniform(std::uint64_t signal, std::int64_t cycle) const noexcept;

  std::uint64_t seed_;
  std::int64_t compute_us_;
  double tail_us_;
  double missed_;
};

}  // namespace sprung::sim
