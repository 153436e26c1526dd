#pragma once
/// A joint that loses its speed faster than its motor could take it away: it has hit its stop, or something
/// that does not give way, and its motor may go on to push. That is what a wrong direction or zero in
/// robot.yaml ends in, where nothing else contradicts it; and a gear that was hit so hard may have slipped.
/// Hit: the mean speeds of 4 ms, and of 4 ms that began 8 ms before, differ by three times what the torque
/// limit gives motor and gear in 8 ms.
///
/// Where a link encoder went along all the while, to 20 mrad, the gear has not slipped: a foot was stubbed,
/// or a robot pushed. Then it is a stop only if the joint stays where it was stopped, within 20 mrad, for 60
/// ms, while its motor pushes with more than half of its limit. Pure; once a sample.
#include <array>
#include <cmath>
#include <cstdint>

#include "signals/vec3.h"

namespace sprung {

class ImpactWatch {
 public:
  /// @param torque_limit_Nm, inertia_kg_m2 of the actuator, output side; inertia 0: not known, nothing is
  /// watched.
  ImpactWatch(double torque_limit_Nm, double inertia_kg_m2, double cycle_s) noexcept;

  struct Sample {
    double position_rad = 0.0;        ///< of motor and gear
    double link_position_rad = kNaN;  ///< of the same sense, any zero; NaN: there is none
    double torque_Nm = 0.0;
  };
  /// @param sync_us of the SYNC that it answers; a gap begins anew.
  void add(const Sample& sample, std::int64_t sync_us) noexcept;
  bool hit() const noexcept { return hit_; }
  /// Of the speed, in 8 ms: the one that was too much, else the last.
  double change_rad_s() const noexcept { return change_rad_s_; }
  void forget() noexcept {
    known_ = 0;
    change_rad_s_ = 0.0;
    hit_ = held_ = false;
  }

 private:
  static constexpr int kMostSpan = 8;  ///< cycles of 4 ms, at 2 kHz
  static constexpr int kMost = 3 * kMostSpan + 1;

  bool link_went_along(const Sample& oldest, const Sample& now) const noexcept;
  bool pushed_there(const Sample& now) noexcept;

  double limit_Nm_;
  std::int64_t cycle_us_;
  int span_;           ///< 4 ms, in cycles
  double span_s_;      ///< what these take
  double most_rad_s_;  ///< infinite: nothing is watched
  std::int64_t last_us_ = 0;
  std::array<Sample, kMost> samples_{};  ///< a ring of 12 ms
  int next_ = 0;
  int known_ = 0;
  double change_rad_s_ = 0.0;
  bool hit_ = false;
  bool held_ = false;  ///< it was stopped so, its link with it, and has not moved since
  double held_at_rad_ = 0.0;
  std::int64_t pushed_us_ = 0;  ///< since when its motor has pushed it there
};

}  // namespace sprung
