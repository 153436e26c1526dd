#pragma once
/// A joint that loses its speed faster than its motor could take it away: it has hit its stop, or something
/// that does not give way, and its motor may go on to push. That is what a wrong direction or zero in
/// robot.yaml ends in, where nothing else contradicts it; and a gear that was hit so hard may have slipped.
/// Hit: the mean speeds of 4 ms, and of 4 ms that began 8 ms before, differ by three times what the torque
/// limit gives motor and gear in 8 ms. Pure; once a sample.
#include <array>
#include <cmath>
#include <cstdint>

namespace sprung {

class ImpactWatch {
 public:
  /// @param torque_limit_Nm, inertia_kg_m2 of the actuator, output side; inertia 0: not known, nothing is
  /// watched.
  ImpactWatch(double torque_limit_Nm, double inertia_kg_m2, double cycle_s) noexcept;

  /// @param answers the SYNC of `sync_us`; a gap begins anew.
  void add(double position_rad, std::int64_t sync_us) noexcept;
  bool hit() const noexcept { return std::abs(change_rad_s_) > most_rad_s_; }
  /// Of the speed, in 8 ms: the one that was too much, else the last.
  double change_rad_s() const noexcept { return change_rad_s_; }
  void forget() noexcept {
    known_ = 0;
    change_rad_s_ = 0.0;
  }

 private:
  static constexpr int kMostSpan = 8;  ///< cycles of 4 ms, at 2 kHz
  static constexpr int kMost = 3 * kMostSpan + 1;

  std::int64_t cycle_us_;
  int span_;           ///< 4 ms, in cycles
  double span_s_;      ///< what these take
  double most_rad_s_;  ///< infinite: nothing is watched
  std::int64_t last_us_ = 0;
  std::array<double, kMost> position_rad_{};  ///< a ring of 12 ms
  int next_ = 0;
  int known_ = 0;
  double change_rad_s_ = 0.0;
};

}  // namespace sprung
