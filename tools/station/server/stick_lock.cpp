#include "tools/station/server/stick_lock.h"

#include <algorithm>
#include <cmath>

namespace sprung::station {
namespace {

bool plausible(double value) noexcept { return std::isfinite(value) && std::abs(value) <= 1.0 + 1e-6; }

bool plausible(const StickValues& v) noexcept {
  return plausible(v.forward) && plausible(v.left) && plausible(v.turning);
}

bool at_rest(const StickValues& v) noexcept {
  return std::max({std::abs(v.forward), std::abs(v.left), std::abs(v.turning)}) <= StickLock::kDeadZone;
}

double beyond_dead_zone(double value) noexcept {
  const double beyond = std::max(0.0, std::abs(value) - StickLock::kDeadZone) / (1.0 - StickLock::kDeadZone);
  return std::copysign(std::min(1.0, beyond), value);
}

}  // namespace

void StickLock::lock(const char* why) noexcept {
  state_ = StickState::kLocked;
  why_locked_ = why;
}

void StickLock::input(const StickInput& input, std::int64_t now_us) noexcept {
  if (!plausible(input.sticks)) return lock("a stick says what no stick can; let go of sticks and dead-man");
  if (state_ != StickState::kLocked && now_us - heard_us_ > kStale_us) state(now_us);
  last_ = input;
  heard_us_ = now_us;
  if (state_ == StickState::kLocked) {
    if (!at_rest(input.sticks) || input.dead_man) return;
    why_locked_ = "";
  }
  state_ = input.dead_man ? StickState::kDriving : StickState::kReady;
}

StickState StickLock::state(std::int64_t now_us) noexcept {
  if (state_ != StickState::kLocked && now_us - heard_us_ > kStale_us)
    lock("nothing was heard of the sticks; let go of sticks and dead-man");
  return state_;
}

StickValues StickLock::values() const noexcept {
  if (state_ != StickState::kDriving) return {};
  return {beyond_dead_zone(last_.sticks.forward), beyond_dead_zone(last_.sticks.left),
          beyond_dead_zone(last_.sticks.turning)};
}

}  // namespace sprung::station
