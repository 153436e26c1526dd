#pragma once
/// A joint that is moved a little way by a torque that grows slowly: does it go, and where to? One step each
/// cycle: values and a time step in, torque and outcome out. Pure.
///
/// Torque is that of an integrator on the difference of speeds, with damping, and is never above the cap:
///   torque = direction * clamp(integral - damping * speed, 0, cap),  integral' = rate / speed *
///   (speed_wanted - speed)
#include "signals/enumeration.h"

namespace sprung::commission {

struct TravelPlan {
  double direction = 1.0;
  double cap_Nm = 0.0;  ///< never asked for more
  double ramp_s = 1.5;  ///< from nothing to the cap, while nothing moves
  double speed_rad_s = 0.05;
  double travel_rad = 0.03;
  double inertia_kg_m2 = 0.8;  ///< that the damping is made for
  double bound_rad = 0.045;    ///< either way: power off
  double fast_rad_s = 0.4;     ///< power off
};

enum class Travel : std::int8_t { kGoing, kArrived, kWrongWay, kNoMotion, kFades, kTooFast, kTooFar };
constexpr auto words_of(Travel) {
  using E = Travel;
  return words<E>({{E::kGoing, "going"},
                   {E::kArrived, "arrived"},
                   {E::kWrongWay, "the wrong way"},
                   {E::kNoMotion, "no motion"},
                   {E::kFades, "torque fades on the way"},
                   {E::kTooFast, "too fast"},
                   {E::kTooFar, "too far"}});
}

class TravelProbe {
 public:
  static constexpr double kMoved_rad = 0.003;  ///< less is play and torsion of the gear [design choice]
  static constexpr double kPatience_s = 0.6;   ///< at the cap without getting further

  explicit TravelProbe(const TravelPlan& plan) noexcept : plan_(plan) {}
  /// @param position_rad in actuator space. @return torque to ask for, actuator space; 0 once it is over.
  double step(double dt_s, double position_rad) noexcept;
  Travel outcome() const noexcept { return outcome_; }

  double moved_rad() const noexcept { return moved_rad_; }        ///< in `direction`
  double farthest_rad() const noexcept { return farthest_rad_; }  ///< either way
  double highest_Nm() const noexcept { return highest_Nm_; }
  /// When it began to move; 0 before.
  double breakaway_Nm() const noexcept { return breakaway_Nm_; }
  /// Mean over the second half of the way, signed, actuator space; 0 where it did not get there.
  double sliding_Nm() const noexcept { return sliding_count_ > 0 ? sliding_sum_Nm_ / sliding_count_ : 0.0; }

 private:
  void watch(double dt_s, double position_rad) noexcept;
  void judge(double dt_s) noexcept;

  TravelPlan plan_;
  Travel outcome_ = Travel::kGoing;
  bool begun_ = false;
  double start_rad_ = 0, last_rad_ = 0, speed_rad_s_ = 0, moved_rad_ = 0, farthest_rad_ = 0;
  double integral_Nm_ = 0, torque_Nm_ = 0, highest_Nm_ = 0, breakaway_Nm_ = 0;
  double stuck_s_ = 0, stuck_at_rad_ = 0, sliding_sum_Nm_ = 0;
  int sliding_count_ = 0;
};

}  // namespace sprung::commission
