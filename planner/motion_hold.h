#pragma once
/// Whether the operator who began a motion is still there: a motion that was begun with a hold ends in a stop
/// when its time is over and nobody has renewed it (design section 8, "operator link lost"). Pure; message
/// time.
#include <cstdint>

namespace sprung {

class MotionHold {
 public:
  /// nullptr, or why such a hold cannot be. @param hold_s NaN: none is asked for.
  static const char* validate(double hold_s) noexcept;

  /// A motion has begun, or goes on otherwise. @param hold_s NaN: it lasts until told.
  void begin(double hold_s, std::int64_t time_us) noexcept;
  /// @return false when nothing is held.
  bool renew(double hold_s, std::int64_t time_us) noexcept;
  /// @return true once, when the time is over.
  bool take_lapse(std::int64_t time_us) noexcept;
  void forget() noexcept { until_us_ = kNone; }

 private:
  static constexpr std::int64_t kNone = -1;
  std::int64_t until_us_ = kNone;
};

}  // namespace sprung
