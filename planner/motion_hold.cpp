#include "planner/motion_hold.h"

#include <cmath>

#include "signals/microseconds.h"

namespace sprung {
namespace {

constexpr double kLongest_s = 3600.0;  // [design choice] nobody watches a robot for longer without a word

}  // namespace

const char* MotionHold::validate(double hold_s) noexcept {
  if (std::isnan(hold_s) || (hold_s > 0.0 && hold_s <= kLongest_s)) return nullptr;
  return "a hold lasts more than 0 s and at most 3600 s";
}

void MotionHold::begin(double hold_s, std::int64_t time_us) noexcept {
  until_us_ = std::isnan(hold_s) ? kNone : time_us + to_us(hold_s);
}

bool MotionHold::renew(double hold_s, std::int64_t time_us) noexcept {
  if (until_us_ == kNone || std::isnan(hold_s)) return false;
  until_us_ = time_us + to_us(hold_s);
  return true;
}

bool MotionHold::take_lapse(std::int64_t time_us) noexcept {
  if (until_us_ == kNone || time_us <= until_us_) return false;
  forget();
  return true;
}

}  // namespace sprung
