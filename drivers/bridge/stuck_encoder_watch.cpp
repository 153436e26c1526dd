#include "drivers/bridge/stuck_encoder_watch.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

constexpr std::int64_t kStill_us = 20'000;  // [design choice] less than half of the 50 ms of design section 8
// [design choice] looked at anew after this: what was long ago says nothing
constexpr std::int64_t kWindow_us = 30'000;
// [design choice] Friction holds a knee under a third of the limit while the hip moves at 1 rad/s: sprung
// experiment push --robot pegasus, and foot_return on single_leg at 0.35 rad/s, would be stopped.
constexpr double kHigh = 0.5;  // of the torque limit
constexpr double kMateMoves_rad = 0.06;
/// A rotor that rests is held by its own friction: its gear twists by what the motor's torque changes by, and
/// by twice that friction. [design choice] half as much again as of a harmonic gear at its peak torque, 108
/// Nm / 10 kNm/rad or 0.011 rad; and for friction, noise and the gear's own error of 0.0003 rad:
constexpr double kTwist_rad = 0.0165;  // at the torque limit
constexpr double kLinkMoves_rad = 0.004;

}  // namespace

bool StuckEncoderWatch::begins_anew(const StuckEncoderInputs& in) noexcept {
  const bool commanded_more = std::abs(in.commanded_torque_Nm) > std::abs(in.measured_torque_Nm);
  torque_Nm_ = commanded_more ? in.commanded_torque_Nm : in.measured_torque_Nm;
  return !any_ || in.position_rad != first_.position_rad || !(std::abs(torque_Nm_) > kHigh * limit_Nm_);
}

bool StuckEncoderWatch::mate_moved(const StuckEncoderInputs& in) const noexcept {
  return std::abs(in.mate_position_rad - first_.mate_position_rad) > kMateMoves_rad;
}

void StuckEncoderWatch::compare_with_link(const StuckEncoderInputs& in) noexcept {
  if (std::isnan(in.link_position_rad)) return;
  if (std::isnan(still_.link_position_rad) || in.position_rad != still_.position_rad) {
    still_ = in;
    torque_change_Nm_ = 0.0;
  }
  const double change_Nm = std::abs(in.measured_torque_Nm - still_.measured_torque_Nm);
  torque_change_Nm_ = std::max(torque_change_Nm_, change_Nm);
  const double twist_rad = kTwist_rad * torque_change_Nm_ / limit_Nm_;
  const double moved_rad = std::abs(in.link_position_rad - still_.link_position_rad);
  link_moved_ = link_moved_ ||
                (in.time_us - still_.time_us >= kStill_us && moved_rad > kLinkMoves_rad + twist_rad);
}

/// A link encoder that repeats one value, or misses a sample, does not say that the joint is held.
void StuckEncoderWatch::watch_link(const StuckEncoderInputs& in) noexcept {
  link_seen_ = link_seen_ && std::isfinite(in.link_position_rad);
  link_alive_ = link_alive_ || in.link_position_rad != first_.link_position_rad;
}

void StuckEncoderWatch::begin(const StuckEncoderInputs& in) noexcept {
  any_ = true;
  first_ = in;
  since_us_ = in.time_us;
  link_seen_ = std::isfinite(in.link_position_rad);
  link_alive_ = false;
}

void StuckEncoderWatch::add(const StuckEncoderInputs& in) noexcept {
  now_us_ = in.time_us;
  compare_with_link(in);
  if (begins_anew(in)) {
    stuck_ = false;
    return begin(in);
  }
  watch_link(in);
  const bool held = link_seen_ && link_alive_;
  stuck_ = stuck_ || (still_us() >= kStill_us && mate_moved(in) && !held);
  if (!stuck_ && still_us() >= kWindow_us) begin(in);
}

void StuckEncoderWatch::forget() noexcept { *this = StuckEncoderWatch(limit_Nm_); }

}  // namespace sprung
