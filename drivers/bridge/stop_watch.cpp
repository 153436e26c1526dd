#include "drivers/bridge/stop_watch.h"

#include <algorithm>

namespace sprung {
namespace {

// [design choice] A control word is obeyed within two cycles of any robot, and answered in the next; a quick
// stop may brake for 0.5 s (power_control.cpp) before its power is taken.
constexpr std::int64_t kOffTime_us = 200'000;
constexpr std::int64_t kBrakingTime_us = 800'000;
constexpr std::int64_t kSdoTime_us = 100'000;    // [design choice] the time-out of one SDO
constexpr std::int64_t kResetTime_us = 100'000;  // [design choice] a drive says boot-up within some 10 ms
// [design choice] five times the longest heartbeat_consumer that a robot may have (robots/robot_sections.cpp)
constexpr std::int64_t kWithholdTime_us = 500'000;

}  // namespace

const char* text(StopStep step) noexcept {
  switch (step) {
    case StopStep::kSdo:
      return "by SDO";
    case StopStep::kReset:
      return "by NMT reset";
    case StopStep::kWithhold:
      return "by withholding the heartbeat";
    case StopStep::kGivenUp:
      return "not at all: cut its supply";
    case StopStep::kPdo:
      return "by control word";
    case StopStep::kNone:
      break;
  }
  return "";
}

void StopWatch::enter(StopStep step, std::int64_t time_us) noexcept {
  step_ = step;
  worst_ = std::max(worst_, step);
  since_us_ = next_reset_us_ = time_us;
}

StopStep StopWatch::update(const StopInputs& in) noexcept {
  if (!in.wanted || in.seen_off) {
    step_ = StopStep::kNone;
    return step_;
  }
  const std::int64_t lasted_us = in.time_us - since_us_;
  switch (step_) {
    case StopStep::kNone:
      worst_ = StopStep::kNone;
      enter(in.takes_pdos ? StopStep::kPdo : StopStep::kSdo, in.time_us);
      break;
    case StopStep::kPdo:
      if (!in.takes_pdos || lasted_us >= (in.brakes ? kBrakingTime_us : kOffTime_us))
        enter(StopStep::kSdo, in.time_us);
      break;
    case StopStep::kSdo:
      if (lasted_us >= kSdoTime_us) enter(StopStep::kReset, in.time_us);
      break;
    case StopStep::kReset:
      if (lasted_us >= kResetTime_us) enter(in.alive ? StopStep::kWithhold : StopStep::kGivenUp, in.time_us);
      break;
    case StopStep::kWithhold:
      if (lasted_us >= kWithholdTime_us) enter(StopStep::kGivenUp, in.time_us);
      break;
    case StopStep::kGivenUp:
      break;
  }
  return step_;
}

bool StopWatch::take_reset(std::int64_t time_us) noexcept {
  if (step_ != StopStep::kReset && step_ != StopStep::kWithhold) return false;
  if (time_us < next_reset_us_) return false;
  next_reset_us_ = time_us + kResetTime_us;
  return true;
}

}  // namespace sprung
