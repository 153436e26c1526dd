#include "planner/fall_detector.h"

#include <algorithm>
#include <cmath>

#include "planner/gait/capture_point.h"

namespace sprung {
namespace {

/// Of the height over the feet: further than of any robot that was pushed in a gait and stayed up (rows
/// push.*.capture_beyond).
constexpr double kBeyond = 0.38;
constexpr double kTipping_rad = 0.1;  // [design choice] whoever slides is as far beyond, and may stay up
constexpr double kBeyond_s = 0.01;    // that long: a velocity may jump at touchdown
/// [design choice] and the swing. A robot in position control that was pushed rocked back from two feet after
/// 1.2 s; without an IMU there is no tilt to tell with.
constexpr double kUnheld_s = 1.5, kUnheldWithoutImu_s = 0.5;
constexpr double kLeaning_rad = 0.2;
constexpr double kLongestCycle_s = 0.005;  // that counts: nobody was seen to fall in a gap

bool tilted(const EstimatedBody& body, double by_rad, const Attitude& from = {}) noexcept {
  const Attitude now = attitude(body.estimated_quaternion_wxyz);
  return std::abs(now.roll_rad - from.roll_rad) > by_rad ||
         std::abs(now.pitch_rad - from.pitch_rad) > by_rad;  // false for NaN
}

}  // namespace

FallDetector::FallDetector(const RobotConfig& robot) : shape_(robot), has_body_(robot.body.mass_kg > 0.0) {
  adjust(robot.body);
  for (std::size_t i = 0; i < robot.legs.size(); ++i) {
    neighbours_[robot.legs[i].hip_in_trunk_m[0] >= 0.0 ? 0 : 1].push_back(i);
    neighbours_[robot.legs[i].hip_in_trunk_m[1] >= 0.0 ? 2 : 3].push_back(i);
  }
}

void FallDetector::adjust(const BodyConfig& body) noexcept {
  tilt_rad_ = body.fallen_tilt_rad;
  height_m_ = body.fallen_height_m;
}

void FallDetector::begin_anew() noexcept {
  unheld_s_.fill(0.0);
  beyond_s_ = 0.0;
  last_us_ = -1;
}

bool FallDetector::lies(const EstimatedBody& body) const noexcept {
  return tilted(body, tilt_rad_) || body.estimated_height_m < height_m_;
}

bool FallDetector::will_fall(const JointState& in, const Attitude& along, double dt_s) noexcept {
  const bool tips = in.body.uses_imu && tilted(in.body, kTipping_rad, along);
  beyond_s_ = tips && capture_beyond(in, shape_) > kBeyond ? beyond_s_ + dt_s : 0.0;
  return beyond_s_ > kBeyond_s;
}

bool FallDetector::unheld(const JointState& in, double swing_s, const Attitude& along, double dt_s) noexcept {
  if (in.body.uses_imu != used_imu_) unheld_s_.fill(0.0);
  used_imu_ = in.body.uses_imu;
  const double longest_s = used_imu_ ? kUnheld_s : kUnheldWithoutImu_s;
  const bool leans = !used_imu_ || tilted(in.body, kLeaning_rad, along);
  const auto held = [&in](std::size_t leg) { return in.legs[leg].contact; };
  bool any = false;
  for (std::size_t side = 0; side < neighbours_.size(); ++side) {
    const auto& legs = neighbours_[side];
    const bool none = leans && !legs.empty() && std::none_of(legs.begin(), legs.end(), held);
    unheld_s_[side] = none ? unheld_s_[side] + dt_s : 0.0;
    any = any || unheld_s_[side] > longest_s + std::max(0.0, swing_s);
  }
  const bool hangs = swing_s < 0.0 && std::none_of(in.legs.begin(), in.legs.end(),
                                                   [](const EstimatedLeg& leg) { return leg.contact; });
  return any && !hangs;
}

Fall FallDetector::step(const JointState& in, double swing_s, const Attitude& along) noexcept {
  const double passed_s = last_us_ < 0 ? 0.0 : 1e-6 * static_cast<double>(in.stamp.utime_us - last_us_);
  const double dt_s = std::clamp(passed_s, 0.0, kLongestCycle_s);
  last_us_ = in.stamp.utime_us;
  found_ = Fall::kNone;
  if (!has_body_) return found_;
  // Each counts its time.
  const bool without_ground = unheld(in, swing_s, along, dt_s), will = will_fall(in, along, dt_s);
  if (lies(in.body) || without_ground) {
    found_ = Fall::kLies;
  } else if (will) {
    found_ = Fall::kFalls;
  }
  return found_;
}

const char* FallDetector::why_not_up(const EstimatedBody& body) const noexcept {
  return has_body_ && body.uses_imu && tilted(body, tilt_rad_) ? "lying on its side or back: turn it over"
                                                               : nullptr;
}

}  // namespace sprung
