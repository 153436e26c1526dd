#include "tools/station/server/gamepad.h"

#include <algorithm>
#include <utility>

namespace sprung::station {
namespace {

constexpr std::uint16_t kSync = 0, kKey = 1, kAbsolute = 3;  // EV_SYN, EV_KEY, EV_ABS
constexpr std::uint16_t kDropped = 3;                        // SYN_DROPPED

/// Linux counts down and to the right; ours is forward and to the left.
double share(std::int32_t value, const AxisRange& range) noexcept {
  const double middle = 0.5 * (static_cast<double>(range.low) + range.high);
  const double half = 0.5 * (static_cast<double>(range.high) - range.low);
  return half > 0.0 ? std::clamp((middle - value) / half, -1.0, 1.0) : 0.0;
}

}  // namespace

void Gamepad::set_range(Axis axis, AxisRange range) noexcept { ranges_[axis] = range; }

void Gamepad::take(const GamepadEvent& event) noexcept {
  if (event.type == kSync && event.code == kDropped) lost_ = true;
  if (event.type == kAbsolute) {
    const auto* const found = std::find(kAxisCodes.begin(), kAxisCodes.end(), event.code);
    if (found == kAxisCodes.end()) return;
    const auto axis = static_cast<std::size_t>(found - kAxisCodes.begin());
    axes_[axis] = share(event.value, ranges_[axis]);
  }
  if (event.type != kKey) return;
  for (std::size_t i = 0; i < kDeadManCodes.size(); ++i)
    if (event.code == kDeadManCodes[i]) dead_man_[i] = event.value != 0;
  if (event.code == kStopCode && event.value == 1) stop_ = true;
}

StickInput Gamepad::input() const noexcept {
  if (lost_) return {};
  return {{axes_[kForward], axes_[kLeft], axes_[kTurning]}, dead_man_[0] || dead_man_[1]};
}

bool Gamepad::take_stop() noexcept { return std::exchange(stop_, false); }

}  // namespace sprung::station
