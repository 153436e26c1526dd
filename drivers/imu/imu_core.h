#pragma once
/// Bytes of a serial Xsens MTi and a time in, IMU samples of the trunk out: axes turned as the sensor is
/// mounted, each stamped with the cycle in which it was measured. Stepped by time; no clock, no line, no
/// allocation.
///
/// Status of what it gives: kGood; kNoAttitude where the sensor sends none that can be, says that its filter
/// is not valid, or has its world's z axis down; kFault where a number is not finite or beyond the sensor's
/// range, or the sensor says that it was clipped; and kFault without numbers, once a cycle, from
/// longest_silence on. What comes before the first DRIVE_STATE has no cycle, and is not given.
///
/// A sensor beside the trunk's centre also feels what its lever arm does; that is not taken off.
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>

#include "drivers/imu/mtdata2.h"
#include "drivers/imu/xbus_parser.h"
#include "robots/gait_config.h"
#include "signals/sensors.h"

namespace sprung::imu {

/// Since the start, for status and people.
struct ImuCounters {
  std::int64_t samples = 0;     ///< given
  std::int64_t surplus = 0;     ///< of a cycle that had one: the sensor is faster than the cycle
  std::int64_t lost = 0;        ///< by the sensor's own counter
  std::int64_t malformed = 0;   ///< good checksum, but no MTData2 that can be
  std::int64_t incomplete = 0;  ///< without rate or force: see the sensor's output configuration
  std::int64_t clipped = 0;     ///< beyond the range, by number or by the sensor's word
  std::int64_t not_finite = 0;
  std::int64_t silences = 0;
};

class ImuCore {
 public:
  ImuCore(const ImuDriverConfig& config, double cycle_s) noexcept;

  /// The newest cycle that is known.
  void cycle(const Stamp& drive_state) noexcept;
  /// @param arrival_us when the byte came. @return true when `out` is a sample to publish.
  bool take(std::uint8_t byte, std::int64_t arrival_us, Imu& out) noexcept;
  /// Call once a turn. @return true when `out` says that the sensor is silent: once a cycle while it is.
  bool watch(std::int64_t time_us, Imu& out) noexcept;
  /// The line was opened anew.
  void restart() noexcept;

  bool silent() const noexcept { return silent_; }
  /// Bytes come, but no message: the baud rate, or another protocol. Judged over the last second.
  bool not_understood(std::int64_t time_us) noexcept;
  const ImuCounters& counters() const noexcept { return counters_; }
  const XbusCounters& line() const noexcept { return parser_.counters(); }
  std::int64_t newest_us() const noexcept { return measured_us_; }  ///< of the newest sample; -1 = none

 private:
  bool take_message(const XbusMessage& message, std::int64_t arrival_us, Imu& out) noexcept;
  std::int64_t cycle_of(std::int64_t time_us) const noexcept;
  void convert(const MtData2& data, Imu& out) noexcept;
  bool in_range(const MtData2& data) noexcept;
  void count_lost(const MtData2& data) noexcept;

  ImuDriverConfig config_;
  double cycle_us_;
  Eigen::Quaterniond sensor_in_trunk_;  ///< turns sensor axes into trunk axes
  XbusParser parser_;
  ImuCounters counters_;
  Stamp drive_state_;
  std::int64_t given_seq_ = -1;
  std::int64_t measured_us_ = -1;
  std::int64_t heard_us_ = -1;  ///< of a message with numbers, or of the first watch()
  bool silent_ = false;
  std::optional<std::uint16_t> last_counter_;
  std::int64_t window_us_ = -1, window_bytes_ = 0, window_messages_ = 0;
  std::int64_t bytes_ = 0;
  bool not_understood_ = false;
};

}  // namespace sprung::imu
