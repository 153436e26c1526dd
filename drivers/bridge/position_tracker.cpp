#include "drivers/bridge/position_tracker.h"

#include <algorithm>
#include <cmath>

#include "signals/stamp.h"

namespace sprung {
namespace {

/// [design choice] 40 Hz: far above the pole of damping / armature, 20 rad/s.
constexpr double kTimeConstant_s = 0.004;
constexpr double kSpeedFactor = 3.0;  // [design choice] over speed_limit: impacts are faster than commands
constexpr double kQuanta = 2.0;       // each of two samples is off by up to one
// [design choice] bits that flip on their way do not show one place so often in a row
constexpr int kJumpSamples = 5;

}  // namespace

bool PositionTracker::can_follow(const Sample& before, double position_rad,
                                 std::int64_t received_us) const noexcept {
  const double longest_s = seconds(std::max<std::int64_t>(received_us - before.time.earliest_us, 0));
  return std::abs(position_rad - before.position_rad) <=
         kSpeedFactor * speed_limit_rad_s_ * longest_s + kQuanta * quantum_rad_;
}

Motion PositionTracker::add(double measured_position_rad, const SampleTime& time) noexcept {
  const Sample sample{measured_position_rad, time, true};
  if (good_.known && !can_follow(good_, measured_position_rad, time.received_us)) {
    const bool beside = rejected_.known && can_follow(rejected_, measured_position_rad, time.received_us);
    rejected_ = sample;
    rejected_beside_ = beside ? rejected_beside_ + 1 : 1;
    if (rejected_beside_ < kJumpSamples) return Motion::kRejected;
    forget_rejected();
    good_ = sample;
    return Motion::kJumped;
  }
  const double step_rad = measured_position_rad - good_.position_rad;
  const double dt_s = seconds(time.sync_us - good_.time.sync_us);
  const bool moves = good_.known && !resumed_ && dt_s > 0.0;
  good_ = sample;
  resumed_ = false;
  forget_rejected();
  if (!moves) return Motion::kGood;
  // A cycle that was sent late is shorter by its time stamps than it was.
  const double fastest_rad_s = kSpeedFactor * speed_limit_rad_s_;
  const double speed_rad_s = std::clamp(step_rad / dt_s, -fastest_rad_s, fastest_rad_s);
  latest_velocity_rad_s_ = speed_rad_s;
  velocity_rad_s_ += (speed_rad_s - velocity_rad_s_) * dt_s / (kTimeConstant_s + dt_s);
  return Motion::kGood;
}

void PositionTracker::resume() noexcept {
  velocity_rad_s_ = latest_velocity_rad_s_ = 0.0;
  resumed_ = true;
  forget_rejected();
}

void PositionTracker::forget_rejected() noexcept {
  rejected_.known = false;
  rejected_beside_ = 0;
}

}  // namespace sprung
