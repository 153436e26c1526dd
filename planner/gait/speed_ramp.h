#pragma once
/// Desired speed of the body: forward, left (m/s), turning (rad/s), at limited acceleration. Pure.
#include <array>

namespace sprung {

class SpeedRamp {
 public:
  /// Before all else, and whenever they are others.
  void limit(double acceleration_m_s2, double turning_acceleration_rad_s2) noexcept {
    most_ = {acceleration_m_s2, acceleration_m_s2, turning_acceleration_rad_s2};
  }
  void reset() noexcept {
    now_.fill(0.0);
    wanted_.fill(0.0);
  }
  void want(const std::array<double, 3>& speed) noexcept {
    wanted_ = speed;
    times_ = 1.0;
  }
  /// To rest within this time, where the acceleration alone would take longer.
  void stop(double within_s) noexcept;
  /// @param most_faster of the acceleration while a speed grows, besides the ramp's own; of several at once
  /// the root of their squared shares' sum is at most 1.
  void advance(double dt_s, const std::array<double, 3>& most_faster) noexcept;
  const std::array<double, 3>& now() const noexcept { return now_; }
  bool arrived() const noexcept { return now_ == wanted_; }
  /// Until it arrives.
  double left_s() const noexcept;

 private:
  bool grows(std::size_t axis) const noexcept;
  std::array<double, 3> shares(const std::array<double, 3>& most_faster) const noexcept;

  std::array<double, 3> most_{};
  std::array<double, 3> now_{};
  std::array<double, 3> wanted_{};
  double times_ = 1.0;  ///< of the acceleration
};

}  // namespace sprung
