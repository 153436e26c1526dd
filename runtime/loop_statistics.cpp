#include "runtime/loop_statistics.h"

#include <algorithm>

namespace sprung {

void SampleWindow::add(double value) noexcept {
  samples_[added_ % kCapacity] = value;
  max_ = added_ == 0 ? value : std::max(max_, value);
  ++added_;
}

void SampleWindow::clear() noexcept {
  added_ = 0;
  max_ = 0.0;
}

double SampleWindow::median() const noexcept {
  if (added_ == 0) return 0.0;
  std::array<double, kCapacity> sorted = samples_;
  const auto count = static_cast<std::ptrdiff_t>(std::min(added_, kCapacity));
  const auto middle = sorted.begin() + count / 2;
  std::nth_element(sorted.begin(), middle, sorted.begin() + count);
  return *middle;
}

void LoopStatistics::begin_cycle(std::int64_t now_us) noexcept {
  if (cycles_ > 0) period_us_.add(static_cast<double>(now_us - begin_us_));
  begin_us_ = now_us;
  ++cycles_;
}

bool LoopStatistics::end_cycle(std::int64_t now_us) noexcept {
  const auto compute_us = static_cast<double>(now_us - begin_us_);
  compute_us_.add(compute_us);
  const bool over = budget_us_ > 0.0 && compute_us > budget_us_;
  if (over) ++overruns_;
  return over;
}

LoopSummary LoopStatistics::summarize() noexcept {
  const LoopSummary summary{period_us_.median(), period_us_.max(), compute_us_.median(), compute_us_.max(),
                            overruns_};
  period_us_.clear();
  compute_us_.clear();
  return summary;
}

}  // namespace sprung
