#include "tools/logs/log/thin_series.h"

#include <cmath>
#include <limits>

namespace sprung::log {

void ThinSeries::add(double x, double y) {
  if (stretches_.empty() || in_last_ == samples_each_) {
    if (stretches_.size() == kMostStretches) halve();
    if (stretches_.empty() || in_last_ == samples_each_) {
      stretches_.emplace_back();
      in_last_ = 0;
    }
  }
  Stretch sample;
  sample.finite = std::isfinite(y) && std::isfinite(x);
  sample.gap = !sample.finite;
  sample.gap_x = x;
  sample.first_extreme = sample.second_extreme = {x, y};
  if (in_last_++ == 0) {
    stretches_.back() = sample;
  } else {
    join(stretches_.back(), sample);
  }
}

void ThinSeries::join(Stretch& stretch, const Stretch& next) noexcept {
  if (next.gap && !stretch.gap) stretch.gap_x = next.gap_x;
  stretch.gap = stretch.gap || next.gap;
  if (!next.finite) return;
  if (!stretch.finite) {
    stretch.first_extreme = next.first_extreme;
    stretch.second_extreme = next.second_extreme;
    stretch.finite = true;
    return;
  }
  // Of up to four samples in their order, the lowest and the highest.
  const Sample all[] = {stretch.first_extreme, stretch.second_extreme, next.first_extreme,
                        next.second_extreme};
  std::size_t low = 0, high = 0;
  for (std::size_t i = 1; i < std::size(all); ++i) {
    if (all[i].y < all[low].y) low = i;
    if (all[i].y > all[high].y) high = i;
  }
  stretch.first_extreme = all[low < high ? low : high];
  stretch.second_extreme = all[low < high ? high : low];
}

void ThinSeries::halve() {
  std::vector<Stretch> half;
  half.reserve(kMostStretches);
  for (std::size_t i = 0; i < stretches_.size(); i += 2) {
    half.push_back(stretches_[i]);
    if (i + 1 < stretches_.size()) join(half.back(), stretches_[i + 1]);
  }
  stretches_ = std::move(half);
  samples_each_ *= 2;
  in_last_ = samples_each_;  // kMostStretches is even: the last one is full
}

template <class Take>
std::vector<double> ThinSeries::collect(Take&& take) const {
  std::vector<double> out;
  for (const Stretch& stretch : stretches_) {
    if (stretch.finite) {
      out.push_back(take(stretch.first_extreme));
      const bool two = stretch.first_extreme.x != stretch.second_extreme.x;
      if (two) out.push_back(take(stretch.second_extreme));
    }
    if (stretch.gap) out.push_back(take({stretch.gap_x, std::numeric_limits<double>::quiet_NaN()}));
  }
  return out;
}

std::vector<double> ThinSeries::x() const {
  return collect([](const Sample& sample) { return sample.x; });
}

std::vector<double> ThinSeries::y() const {
  return collect([](const Sample& sample) { return sample.y; });
}

}  // namespace sprung::log
