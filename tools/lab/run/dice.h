#pragma once
/// Draws that are the same on every machine, which the standard library's distributions do not promise. Pure.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

namespace sprung {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}

  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_() >> 11) * 0x1p-53;
  }
  /// As likely between 1 and 2 as between 10 and 20. @param low above 0.
  double scale(double low, double high) { return std::exp(between(std::log(low), std::log(high))); }
  std::size_t below(std::size_t count) {
    return std::min(count - 1, static_cast<std::size_t>(between(0.0, static_cast<double>(count))));
  }
  bool one_in(std::size_t count) { return below(count) == 0; }
  double either_sign(double value) { return one_in(2) ? -value : value; }
  template <class Values>
  auto one_of(const Values& all) {
    return all[below(all.size())];
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace sprung
