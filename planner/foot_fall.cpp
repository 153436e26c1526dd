#include "planner/foot_fall.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

constexpr double kStretchPeakToMean = 1.875;     // of FootMove's speed
constexpr double kStretchAcceleration = 5.7735;  // of FootMove: its peak times duration^2 over way
constexpr double kStretchSpeed_m_s = 1.8;        // what the joints can do with a long leg
constexpr double kStretchShare = 0.7;            // at most, of the fall

}  // namespace

void FootFall::begin(std::int64_t utime_us, const FootPoint& from,
                     const ExpectedTouchdown& expected) noexcept {
  expected_ = expected;
  now_us_ = begun_us_ = utime_us;
  foot_ = from;
  slow_m_s_ = std::min(config_.approach_m_s, config_.approach_share * expected.approach_speed_m_s);
  const double left_s = 1e-6 * static_cast<double>(expected_.utime_us - now_us_);
  const double duration_s = std::clamp(kStretchShare * left_s, 1e-3, config_.extension_s);
  const double from_m = -foot_.position_m[2];
  const double way_m = std::min(
      kStretchSpeed_m_s * duration_s / kStretchPeakToMean,
      config_.stretch_acceleration_m_s2 * duration_s * duration_s / kStretchAcceleration);
  const double to_m = std::clamp(config_.extended_length_m, from_m - way_m, from_m + way_m);
  move_ = {foot_.position_m, {config_.foot_x_m, 0.0, -to_m}, duration_s};
  braking_ = false;
}

void FootFall::step(std::int64_t utime_us) noexcept {
  const double dt_s = std::clamp(1e-6 * static_cast<double>(utime_us - now_us_), 0.0, kLongestStep_s);
  now_us_ = utime_us;
  if (braking_) brake(dt_s);  // before stretch(), whose last cycle has moved the foot
  if (!braking_) stretch();
}

double FootFall::hip_height_m() const noexcept {
  const double left_s = 1e-6 * static_cast<double>(expected_.utime_us - now_us_);
  return landing_length_m_ + left_s * (expected_.approach_speed_m_s - 0.5 * kGravity_m_s2 * left_s);
}

double FootFall::hip_velocity_m_s() const noexcept {
  const double left_s = 1e-6 * static_cast<double>(expected_.utime_us - now_us_);
  return -(expected_.approach_speed_m_s - kGravity_m_s2 * left_s);
}

FootPoint FootFall::stretched() const noexcept {
  return move_.at(1e-6 * static_cast<double>(now_us_ - begun_us_));
}

/// Until the foot, braked from now on, would have its approach speed where it is to have it.
void FootFall::stretch() noexcept {
  foot_ = stretched();
  approach_m_s_ = -(hip_velocity_m_s() + foot_.velocity_m_s[2]);
  const double way_m = std::max(0.0, hip_height_m() + foot_.position_m[2] - config_.early_m);
  if (approach_m_s_ <= slow_m_s_ || braking_way_m() < way_m) return;
  braking_ = true;
  braking_m_s2_ = 0.0;
}

void FootFall::set_x(const FootPoint& like) noexcept {
  foot_.position_m[0] = like.position_m[0];
  foot_.velocity_m_s[0] = like.velocity_m_s[0];
  foot_.acceleration_m_s2[0] = like.acceleration_m_s2[0];
}

double FootFall::braking_way_m() const noexcept {
  const double excess_m_s = approach_m_s_ - slow_m_s_;
  const double most_m_s2 = std::min(config_.braking_m_s2, std::sqrt(config_.braking_jerk_m_s3 * excess_m_s));
  const double takes_s = excess_m_s / most_m_s2 + most_m_s2 / config_.braking_jerk_m_s3;
  return 0.5 * (approach_m_s_ + slow_m_s_) * takes_s;
}

void FootFall::brake(double dt_s) noexcept {
  set_x(stretched());
  const double excess_m_s = std::max(0.0, approach_m_s_ - slow_m_s_);
  const double ending_m_s2 = std::sqrt(2.0 * config_.braking_jerk_m_s3 * excess_m_s);
  const double step_m_s2 = config_.braking_jerk_m_s3 * dt_s;
  braking_m_s2_ = std::clamp(std::min(config_.braking_m_s2, ending_m_s2), braking_m_s2_ - step_m_s2,
                             braking_m_s2_ + step_m_s2);
  approach_m_s_ -= std::min(excess_m_s, braking_m_s2_ * dt_s);
  const double wanted_m_s = -approach_m_s_ - hip_velocity_m_s();
  const bool fastest = wanted_m_s > config_.fastest_m_s;
  const bool shortest = -foot_.position_m[2] <= config_.shortest_m + kLeastWay_m;
  double& velocity = foot_.velocity_m_s[2];
  velocity = shortest ? 0.0 : std::min(wanted_m_s, config_.fastest_m_s);
  foot_.acceleration_m_s2[2] = fastest || shortest ? 0.0 : kGravity_m_s2 + braking_m_s2_;
  foot_.position_m[2] += velocity * dt_s;
}

}  // namespace sprung
