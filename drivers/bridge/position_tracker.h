#pragma once
/// Velocity of one actuator for the bridge's own damping: differences of the measured position through a
/// first-order low-pass. Pure.
#include <cstdint>

namespace sprung {

class PositionTracker {
 public:
  /// @param speed_limit_rad_s of the actuator; what moves several times faster is no measurement.
  explicit PositionTracker(double speed_limit_rad_s) : speed_limit_rad_s_(speed_limit_rad_s) {}

  /// @param time_us of the SYNC that sampled. @return false when the step from the last position is
  /// implausible; the velocity stays as it was, the next step counts from here.
  bool add(double measured_position_rad, std::int64_t time_us) noexcept;
  void reset() noexcept { known_ = false; }
  double filtered_velocity_rad_s() const noexcept { return velocity_rad_s_; }

 private:
  double speed_limit_rad_s_;
  double last_position_rad_ = 0.0;
  double velocity_rad_s_ = 0.0;
  std::int64_t last_us_ = 0;
  bool known_ = false;
};

}  // namespace sprung
