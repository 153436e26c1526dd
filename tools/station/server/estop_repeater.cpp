#include "tools/station/server/estop_repeater.h"

#include <limits>

namespace sprung::station {

bool EstopRepeater::press(std::int64_t now_us) noexcept {
  if (state_ == EstopState::kPressed) return false;
  state_ = EstopState::kPressed;
  pressed_us_ = now_us;
  due_us_ = now_us;
  return true;
}

bool EstopRepeater::drives(bool may_have_torque, std::int64_t state_us) noexcept {
  if (state_ != EstopState::kPressed || may_have_torque || state_us <= pressed_us_) return false;
  state_ = EstopState::kConfirmed;
  confirmed_us_ = state_us;
  return true;
}

bool EstopRepeater::due(std::int64_t now_us) noexcept {
  if (state_ != EstopState::kPressed || now_us < due_us_) return false;
  due_us_ = now_us + kAgain_us;
  return true;
}

std::int64_t EstopRepeater::next_us() const noexcept {
  return state_ == EstopState::kPressed ? due_us_ : std::numeric_limits<std::int64_t>::max();
}

}  // namespace sprung::station
