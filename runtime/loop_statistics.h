#pragma once
/// What a loop measures of itself. Pure, fixed memory, no allocation: median and maximum of period and
/// compute time since the last summary, and overruns since the start.
#include <array>
#include <cstddef>
#include <cstdint>

namespace sprung {

struct LoopSummary {
  double period_median_us = 0.0;  ///< 0 when nothing ran
  double period_max_us = 0.0;
  double compute_median_us = 0.0;  ///< input taken to output sent
  double compute_max_us = 0.0;
  std::int64_t overruns = 0;  ///< cycles since the start whose compute time exceeded the budget
};

/// Newest 2048 samples of a window, and their exact maximum.
class SampleWindow {
 public:
  static constexpr std::size_t kCapacity = 2048;
  void add(double value) noexcept;
  void clear() noexcept;
  double median() const noexcept;  ///< upper median of the newest samples; 0 when empty
  double max() const noexcept { return max_; }

 private:
  std::array<double, kCapacity> samples_{};
  std::size_t added_ = 0;
  double max_ = 0.0;
};

class LoopStatistics {
 public:
  /// @param budget_us compute time that a cycle may take; 0 = without limit (lock-step).
  explicit LoopStatistics(double budget_us = 0.0) noexcept : budget_us_(budget_us) {}
  void begin_cycle(std::int64_t now_us) noexcept;  ///< input taken
  bool end_cycle(std::int64_t now_us) noexcept;    ///< output sent; true when over budget
  LoopSummary summarize() noexcept;                ///< and begins a new window
  std::int64_t cycles() const noexcept { return cycles_; }

 private:
  double budget_us_;
  SampleWindow period_us_;
  SampleWindow compute_us_;
  std::int64_t begin_us_ = -1;
  std::int64_t cycles_ = 0;
  std::int64_t overruns_ = 0;
};

}  // namespace sprung
