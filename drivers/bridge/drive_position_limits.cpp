#include "drivers/bridge/drive_position_limits.h"

#include <algorithm>
#include <cmath>

#include "drivers/canopen/objects.h"
#include "model/transmission.h"

namespace sprung {
namespace {

std::int32_t to_i32(std::int64_t counts) noexcept {
  return static_cast<std::int32_t>(std::clamp<std::int64_t>(counts, std::numeric_limits<std::int32_t>::min(),
                                                            std::numeric_limits<std::int32_t>::max()));
}

/// Over all corners of the box of the leg's joints: where joints are coupled, actuators go further than each
/// joint by itself lets them.
PositionRange range_in_leg(const RobotConfig& robot, const LegConfig& leg, std::size_t place) {
  const Transmission transmission(leg);
  const auto joints = static_cast<unsigned>(leg.joints.size());
  PositionRange out{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (unsigned corner = 0; corner < 1U << joints; ++corner) {
    JointVector at_rad(transmission.size());
    for (unsigned j = 0; j < joints; ++j) {
      const JointConfig& joint = robot.joints.at(leg.joints[j]);
      at_rad[j] = (corner >> j & 1U) != 0 ? joint.position_max_rad + kDriveLimitMargin_rad
                                          : joint.position_min_rad - kDriveLimitMargin_rad;
    }
    const double actuator_rad = transmission.actuator_from_joint(at_rad)[static_cast<int>(place)];
    out = {std::min(out.low_rad, actuator_rad), std::max(out.high_rad, actuator_rad)};
  }
  return out;
}

}  // namespace

PositionRange drive_range(const RobotConfig& robot, int actuator) {
  for (const LegConfig& leg : robot.legs) {
    const auto found = std::find(leg.actuators.begin(), leg.actuators.end(), actuator);
    if (found != leg.actuators.end()) return range_in_leg(robot, leg, found - leg.actuators.begin());
  }
  return {};
}

DrivePositionLimits::DrivePositionLimits(std::uint16_t index, const PositionRange& range,
                                         double counts_per_rad) noexcept
    : index_(std::isfinite(range.low_rad) && std::isfinite(range.high_rad) ? index : std::uint16_t{0}),
      range_(range),
      counts_per_rad_(counts_per_rad) {}

void DrivePositionLimits::follow(double zero_rad, double here_rad, bool powered) noexcept {
  if (index_ == 0) return;
  const bool outside = here_rad < told_.low_rad || here_rad > told_.high_rad;
  const bool wide = told_.low_rad < range_.low_rad || told_.high_rad > range_.high_rad;
  const bool inside = here_rad > range_.low_rad && here_rad < range_.high_rad;
  if (zero_rad == told_zero_rad_ && !(outside && !powered) && !(wide && inside)) return;
  told_zero_rad_ = zero_rad;
  told_ = range_;
  if (!inside)
    told_ = {std::min(range_.low_rad, here_rad - kDriveLimitMargin_rad),
             std::max(range_.high_rad, here_rad + kDriveLimitMargin_rad)};
  want(std::llround(counts_per_rad_ * (told_.low_rad - zero_rad)),
       std::llround(counts_per_rad_ * (told_.high_rad - zero_rad)));
}

void DrivePositionLimits::want(std::int64_t one_counts, std::int64_t other_counts) noexcept {
  const std::int32_t low = to_i32(std::min(one_counts, other_counts));
  const std::int32_t high = to_i32(std::max(one_counts, other_counts));
  if (wanted_ && low == low_ && high == high_) return;
  high_first_ = wanted_ && low > high_;
  wanted_ = true;
  low_ = low;
  high_ = high;
  step_ = failures_ = 0;
}

void DrivePositionLimits::forget() noexcept { *this = DrivePositionLimits(index_, range_, counts_per_rad_); }

std::optional<LimitTransfer> DrivePositionLimits::transfer() const noexcept {
  const bool is_high = (step_ % 2 == 1) != high_first_;
  const auto value = static_cast<std::uint32_t>(is_high ? high_ : low_);
  return LimitTransfer{step_ < 2, {index_, static_cast<std::uint8_t>(is_high ? 2 : 1)}, value};
}

void DrivePositionLimits::took(bool good, std::uint32_t value) noexcept {
  const std::optional<LimitTransfer> asked = next();
  if (!asked) return;
  if (good && (asked->write || value == asked->value)) {
    ++step_;
    if (step_ == kDone) failures_ = 0;
    return;
  }
  ++failures_;
  step_ = 0;
  high_first_ = !high_first_;
}

void DrivePositionLimits::retry() noexcept {
  if (failures_ == 0) return;
  failures_ = step_ = 0;
}

}  // namespace sprung
