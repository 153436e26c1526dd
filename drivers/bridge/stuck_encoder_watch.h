#pragma once
/// A motor encoder that shows the same count on and on although its joint must move. Standing is a torque
/// that moves nothing, and friction or a stop may hold a joint whose torque changes; but in a leg that
/// thrusts hip and knee move. So an encoder is stuck that has not moved by one count for 20 ms, under more
/// than half of the torque limit all the time, while the other of the two has moved by 0.06 rad within 30 ms.
/// Less would stop healthy robots that are pushed or pulled (docs/safety.md). Where there is a link encoder,
/// it decides: one that sticks, under whatever torque, is found when the link encoder sees the joint move by
/// 4 mrad, and by what its gear gives way as the motor's torque changes, while the motor's has not moved by
/// one count for 20 ms; and friction holds a joint whose link encoder is alive and sees less. Pure; once a
/// sample.
#include <cstdint>

#include "signals/vec3.h"

namespace sprung {

struct StuckEncoderInputs {
  std::int64_t time_us = 0;
  double position_rad = 0.0;         ///< as the encoder says, any zero
  double measured_torque_Nm = 0.0;   ///< ratio times motor torque, output side
  double commanded_torque_Nm = 0.0;  ///< of the last set-point; NaN outside of torque control. A drive that
                                     ///< repeats its whole answer shows no torque
  double link_position_rad = kNaN;   ///< as the link encoder says; NaN: there is none, or no sample
  double mate_position_rad = 0.0;    ///< of the other joint of its leg that swings in the same plane
};

class StuckEncoderWatch {
 public:
  /// @param torque_limit_Nm of the actuator, output side of its gear.
  explicit StuckEncoderWatch(double torque_limit_Nm) noexcept : limit_Nm_(torque_limit_Nm) {}

  void add(const StuckEncoderInputs& in) noexcept;
  bool stuck() const noexcept { return stuck_ || link_moved_; }
  double torque_Nm() const noexcept { return torque_Nm_; }  ///< of the last sample
  std::int64_t still_us() const noexcept { return now_us_ - (link_moved_ ? still_.time_us : since_us_); }
  void forget() noexcept;

 private:
  void begin(const StuckEncoderInputs& in) noexcept;
  bool begins_anew(const StuckEncoderInputs& in) noexcept;
  void watch_link(const StuckEncoderInputs& in) noexcept;
  void compare_with_link(const StuckEncoderInputs& in) noexcept;
  bool mate_moved(const StuckEncoderInputs& in) const noexcept;

  double limit_Nm_;
  double torque_Nm_ = 0.0;
  StuckEncoderInputs first_;   ///< since which the position has not changed, and the torque was high
  std::int64_t since_us_ = 0;  ///< of that
  std::int64_t now_us_ = 0;
  StuckEncoderInputs still_;       ///< since which the position has not changed, and the link was seen
  double torque_change_Nm_ = 0.0;  ///< at most, since still_
  bool link_seen_ = false;         ///< in every sample since first_
  bool link_alive_ = false;        ///< it has changed since
  bool any_ = false;
  bool link_moved_ = false;
  bool stuck_ = false;
};

}  // namespace sprung
