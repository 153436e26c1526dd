#include "drivers/imu/imu_core.h"

#include <algorithm>
#include <cmath>

namespace sprung::imu {
namespace {

constexpr std::int64_t kWindow_us = 1'000'000;
constexpr double kLengthError = 0.05;             // a quaternion of another length is no attitude
constexpr std::int64_t kBytesWorthJudging = 100;  // in a window: a cable that is plugged in makes some

Eigen::Quaterniond mounting(const ImuDriverConfig& config) {
  using Eigen::AngleAxisd, Eigen::Vector3d;
  return Eigen::Quaterniond(AngleAxisd(config.mounting_yaw_rad, Vector3d::UnitZ()) *
                            AngleAxisd(config.mounting_pitch_rad, Vector3d::UnitY()) *
                            AngleAxisd(config.mounting_roll_rad, Vector3d::UnitX()));
}

Vec3 turned(const Eigen::Quaterniond& by, const std::array<double, 3>& v) noexcept {
  const Eigen::Vector3d out = by * Eigen::Vector3d(v[0], v[1], v[2]);
  return {out.x(), out.y(), out.z()};
}

template <class Numbers>
bool all_finite(const Numbers& numbers) noexcept {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); });
}

template <class Numbers>
bool within(const Numbers& numbers, double range) noexcept {
  return std::all_of(numbers.begin(), numbers.end(), [range](double x) { return std::abs(x) < range; });
}

}  // namespace

ImuCore::ImuCore(const ImuDriverConfig& config, double cycle_s) noexcept
    : config_(config), cycle_us_(1e6 * cycle_s), sensor_in_trunk_(mounting(config)) {
  drive_state_.seq = -1;
}

void ImuCore::cycle(const Stamp& drive_state) noexcept { drive_state_ = drive_state; }

void ImuCore::restart() noexcept {
  parser_.restart();
  last_counter_.reset();
}

/// The nearest SYNC: a sample that was measured shortly before the next one is that one's.
std::int64_t ImuCore::cycle_of(std::int64_t time_us) const noexcept {
  return drive_state_.seq + std::llround(static_cast<double>(time_us - drive_state_.utime_us) / cycle_us_);
}

bool ImuCore::take(std::uint8_t byte, std::int64_t arrival_us, Imu& out) noexcept {
  ++bytes_;
  XbusMessage message;
  return parser_.take(byte, message) && message.id == kMtData2 && take_message(message, arrival_us, out);
}

bool ImuCore::take_message(const XbusMessage& message, std::int64_t arrival_us, Imu& out) noexcept {
  MtData2 data;
  if (!decode_mtdata2(message.data, message.size, data)) {
    ++counters_.malformed;
    return false;
  }
  count_lost(data);
  if (!data.has_rate || !data.has_force) {
    ++counters_.incomplete;
    return false;
  }
  heard_us_ = arrival_us;
  silent_ = false;
  measured_us_ = arrival_us - std::llround(1e6 * config_.latency_s);
  if (drive_state_.seq < 0) return false;
  const std::int64_t seq = cycle_of(measured_us_);
  if (seq <= given_seq_ || seq < 0) {
    ++counters_.surplus;
    return false;
  }
  given_seq_ = seq;
  ++counters_.samples;
  out = {};
  out.stamp = {measured_us_, seq};
  convert(data, out);
  return true;
}

void ImuCore::count_lost(const MtData2& data) noexcept {
  if (!data.has_counter) return;
  if (last_counter_) counters_.lost += static_cast<std::uint16_t>(data.counter - *last_counter_ - 1);
  last_counter_ = data.counter;
}

bool ImuCore::in_range(const MtData2& data) noexcept {
  if (!all_finite(data.rate_rad_s) || !all_finite(data.force_m_s2)) {
    ++counters_.not_finite;
    return false;
  }
  const bool said = data.has_status && (data.status & (kStatusClippedForce | kStatusClippedRate)) != 0;
  if (!said && within(data.rate_rad_s, config_.range_rad_s) && within(data.force_m_s2, config_.range_m_s2))
    return true;
  ++counters_.clipped;
  return false;
}

void ImuCore::convert(const MtData2& data, Imu& out) noexcept {
  out.status = ImuStatus::kFault;
  if (!in_range(data)) return;
  out.measured_angular_velocity_rad_s = turned(sensor_in_trunk_, data.rate_rad_s);
  out.measured_specific_force_m_s2 = turned(sensor_in_trunk_, data.force_m_s2);
  out.status = ImuStatus::kNoAttitude;
  const bool valid = !data.has_status || (data.status & kStatusFilterValid) != 0;
  if (!data.has_quaternion || data.world_is_down || !valid || !all_finite(data.quaternion_wxyz)) return;
  const std::array<double, 4>& q = data.quaternion_wxyz;
  const Eigen::Quaterniond sensor(q[0], q[1], q[2], q[3]);
  if (!(std::abs(sensor.norm() - 1.0) < kLengthError)) return;
  const Eigen::Quaterniond trunk = sensor * sensor_in_trunk_.conjugate();
  out.measured_quaternion_wxyz = {trunk.w(), trunk.x(), trunk.y(), trunk.z()};
  out.status = ImuStatus::kGood;
}

bool ImuCore::watch(std::int64_t time_us, Imu& out) noexcept {
  if (heard_us_ < 0) heard_us_ = time_us;
  const bool gone = static_cast<double>(time_us - heard_us_) > 1e6 * config_.longest_silence_s;
  if (gone && !silent_) ++counters_.silences;
  silent_ = gone;
  if (!gone || drive_state_.seq <= given_seq_) return false;
  given_seq_ = drive_state_.seq;
  out = {};
  out.stamp = {time_us, given_seq_};
  out.status = ImuStatus::kFault;
  return true;
}

bool ImuCore::not_understood(std::int64_t time_us) noexcept {
  if (window_us_ < 0) window_us_ = time_us;
  if (time_us - window_us_ >= kWindow_us) {
    not_understood_ = bytes_ - window_bytes_ >= kBytesWorthJudging && line().messages == window_messages_;
    window_us_ = time_us;
    window_bytes_ = bytes_;
    window_messages_ = line().messages;
  }
  return not_understood_;
}

}  // namespace sprung::imu
