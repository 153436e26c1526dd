#pragma once
/// Planned way of a foot through the air, from the beginning of a fall until it touches the ground:
///   stretch   the leg gets longer: an earlier and slower touchdown, more way to stop in;
///   braking   the foot is drawn in so that it slows down over ground, to a small speed a little above where
///             the ground is expected; with that speed it goes on.
/// docs/control.md, "Landing". Pure; time is the message's. Copied, it tells what is to come.
#include <cstdint>

#include "planner/ballistics.h"
#include "planner/foot_move.h"
#include "robots/adaptive_landing_config.h"

namespace sprung {

inline constexpr double kLongestStep_s = 0.02;  ///< of time that one step accounts for
inline constexpr double kLeastWay_m = 0.03;     ///< to stop in, however short the leg is at contact

class FootFall {
 public:
  /// @param landing_length_m of the leg at the touchdown that is expected.
  FootFall(const AdaptiveLandingConfig& config, double landing_length_m) noexcept
      : config_(config), landing_length_m_(landing_length_m) {}

  /// @param from the foot now, hip axes.
  void begin(std::int64_t utime_us, const FootPoint& from, const ExpectedTouchdown& expected) noexcept;
  /// Instead of robot.yaml's: less where the motors cannot.
  void set_braking(double most_m_s2) noexcept { config_.braking_m_s2 = most_m_s2; }
  void step(std::int64_t utime_us) noexcept;

  const FootPoint& foot() const noexcept { return foot_; }  ///< hip axes
  bool braking() const noexcept { return braking_; }
  /// Whether it has its approach speed.
  bool braked() const noexcept { return braking_ && approach_m_s_ <= slow_m_s_; }
  /// Over ground, once it has braked.
  double slow_m_s() const noexcept { return slow_m_s_; }
  std::int64_t utime_us() const noexcept { return now_us_; }
  /// Of the hip over the expected ground, in free fall.
  double hip_height_m() const noexcept;
  double hip_velocity_m_s() const noexcept;

 private:
  void stretch() noexcept;
  void brake(double dt_s) noexcept;
  FootPoint stretched() const noexcept;
  /// Along x the foot goes on while it brakes.
  void set_x(const FootPoint& like) noexcept;
  /// In which the foot slows down to its approach speed.
  double braking_way_m() const noexcept;

  AdaptiveLandingConfig config_;
  double landing_length_m_;
  ExpectedTouchdown expected_;
  std::int64_t begun_us_ = 0;
  std::int64_t now_us_ = 0;
  FootMove move_;  ///< of the stretch
  FootPoint foot_;
  bool braking_ = false;
  double slow_m_s_ = 0.0;      ///< of the foot over ground, once it has braked
  double approach_m_s_ = 0.0;  ///< of the foot over ground, downward
  double braking_m_s2_ = 0.0;  ///< now
};

}  // namespace sprung
