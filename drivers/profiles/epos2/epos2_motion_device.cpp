#include "drivers/profiles/epos2/epos2_motion_device.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "drivers/canopen/objects.h"
#include "drivers/cia402/words.h"

namespace sprung::sim {
namespace {

// Objects of the profile modes (facts canopen 2.4): rpm and rpm/s.
constexpr std::uint16_t kVelocitySetting = 0x206B;
constexpr std::uint16_t kMaxProfileVelocity = 0x607F;
constexpr std::uint16_t kProfileVelocity = 0x6081;
constexpr std::uint16_t kProfileAcceleration = 0x6083;
constexpr std::uint16_t kProfileDeceleration = 0x6084;
constexpr std::uint16_t kTargetVelocity = 0x60FF;

// Control word bits of profile position.
constexpr std::uint16_t kNewSetPoint = 1U << 4;
constexpr std::uint16_t kAtOnce = 1U << 5;
constexpr std::uint16_t kRelative = 1U << 6;

constexpr std::uint16_t kAcknowledgeOrStill = 1U << 12;
constexpr double kWindow_counts = 50.0;  ///< [U] as in position mode
constexpr double kStill_rpm = 10.0;      ///< [U]

}  // namespace

bool Epos2Motion::drives(ModeUse mode) noexcept {
  return mode == ModeUse::kProfilePosition || mode == ModeUse::kProfileVelocity || mode == ModeUse::kVelocity;
}

double Epos2Motion::object(std::uint16_t index) const noexcept {
  return static_cast<double>(dictionary_.get({index, 0}));
}

double Epos2Motion::counts_s(double rpm, const DriveMoment& now) const noexcept {
  return rpm / rpm_per_rad_s_ * now.counts_per_rad;
}

ProfileLimits Epos2Motion::limits(const DriveMoment& now) const noexcept {
  const bool position = now.mode == ModeUse::kProfilePosition;
  const double speed_rpm = std::min(position ? object(kProfileVelocity) : object(kMaxProfileVelocity),
                                    object(kMaxProfileVelocity));
  const double at_once = std::numeric_limits<double>::max();
  if (now.mode == ModeUse::kVelocity) return {counts_s(speed_rpm, now), at_once, at_once};
  return {counts_s(speed_rpm, now), counts_s(object(kProfileAcceleration), now),
          counts_s(object(kProfileDeceleration), now)};
}

/// Called each tick, so that an edge between two is seen.
void Epos2Motion::take_target() noexcept {
  const auto word = static_cast<std::uint16_t>(dictionary_.get({canopen::kControlWord, 0}));
  const bool asked = (word & kNewSetPoint) != 0;
  if (!asked) acknowledged_ = false;
  const bool resting = motion_.reference().velocity_counts_s == 0.0;
  if (asked && !acknowledged_) {
    acknowledged_ = true;
    const double from = (word & kRelative) == 0 ? 0.0 : waiting_ ? next_counts_ : target_counts_;
    next_counts_ = from + object(canopen::kTargetPosition);
    waiting_ = true;
    if ((word & kAtOnce) == 0) return;
    target_counts_ = next_counts_;
    waiting_ = false;
  } else if (waiting_ && resting) {
    target_counts_ = next_counts_;
    waiting_ = false;
  }
}

void Epos2Motion::step(const DriveMoment& now) noexcept {
  if (!now.powered || now.braking || !drives(now.mode)) return forget();
  if (!active_ || mode_ != now.mode) {
    motion_.enter(now.counts,
                  now.mode == ModeUse::kProfilePosition ? 0.0 : now.velocity_rad_s * now.counts_per_rad);
    target_counts_ = now.counts;
    waiting_ = acknowledged_ = false;
  }
  active_ = true;
  mode_ = now.mode;
  if (mode_ == ModeUse::kProfilePosition) {
    take_target();
    motion_.to_position(target_counts_, limits(now), now.dt_s);
  } else {
    const double rpm = object(mode_ == ModeUse::kVelocity ? kVelocitySetting : kTargetVelocity);
    motion_.to_velocity(counts_s(rpm, now), limits(now), now.dt_s);
  }
}

std::uint16_t Epos2Motion::status_bits(const DriveMoment& now) const noexcept {
  if (!active_) return 0;
  if (mode_ == ModeUse::kProfilePosition) {
    const bool there = !waiting_ && motion_.reference().position_counts == target_counts_ &&
                       std::abs(target_counts_ - now.counts) <= kWindow_counts;
    return static_cast<std::uint16_t>((there ? cia402::kTargetReachedBit : 0) |
                                      (acknowledged_ ? kAcknowledgeOrStill : 0));
  }
  const double rpm = now.velocity_rad_s * rpm_per_rad_s_;
  const double wanted = object(mode_ == ModeUse::kVelocity ? kVelocitySetting : kTargetVelocity);
  const bool reached = std::abs(wanted - rpm) <= kStill_rpm;
  const bool still = mode_ == ModeUse::kProfileVelocity && std::abs(rpm) <= kStill_rpm;
  return static_cast<std::uint16_t>((reached ? cia402::kTargetReachedBit : 0) |
                                    (still ? kAcknowledgeOrStill : 0));
}

}  // namespace sprung::sim
