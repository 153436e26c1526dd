#pragma once
/// So many a second, and some at once. Pure.
#include <algorithm>
#include <cstdint>

namespace sprung::gateway {

class TokenBucket {
 public:
  TokenBucket(double each_second, double at_once) noexcept
      : each_second_(each_second), most_(at_once), tokens_(at_once) {}

  bool take(std::int64_t now_us) noexcept {
    if (any_)
      tokens_ = std::min(most_, tokens_ + 1e-6 * each_second_ * static_cast<double>(now_us - last_us_));
    any_ = true;
    last_us_ = now_us;
    if (tokens_ < 1.0) return false;
    tokens_ -= 1.0;
    return true;
  }

 private:
  double each_second_, most_, tokens_;
  std::int64_t last_us_ = 0;
  bool any_ = false;
};

}  // namespace sprung::gateway
