#pragma once
/// Whose turn it is to swing. Pure; time comes in steps.
#include <array>
#include <cstddef>

#include "robots/gait_config.h"

namespace sprung {

inline constexpr std::size_t kMostLegs = 4;

class GaitClock {
 public:
  /// Begins as long before the first swing as all feet stand. @param gait outlives this.
  void begin(const GaitConfig& gait, std::size_t legs) noexcept;
  /// From now on no leg begins to swing; those that do go on.
  void hold() noexcept { holding_ = true; }
  void resume() noexcept { holding_ = false; }
  bool holds() const noexcept { return holding_; }
  /// A leg that still looks for the ground must not be left behind: call with 0 while it does.
  void advance(double dt_s) noexcept;

  bool swings(std::size_t leg) const noexcept { return swinging_[leg]; }
  /// Of the swing, 0..1; 1 beyond its end.
  double swing_share(std::size_t leg) const noexcept;
  double swing_s() const noexcept { return gait_->period_s * (1.0 - gait_->duty); }
  double stance_s() const noexcept { return gait_->period_s * gait_->duty; }
  /// Until the leg's next swing, s; large where none is to come.
  double until_swing_s(std::size_t leg) const noexcept;
  /// The foot has landed: before its time, or after it.
  void land(std::size_t leg) noexcept { swinging_[leg] = false; }
  bool all_stand() const noexcept;
  /// Steps that were begun by the leg that has made the fewest, since begin() or count_anew().
  int rounds() const noexcept;
  /// A step that is under way counts as the leg's first.
  void count_anew() noexcept;
  double phase() const noexcept { return phase_; }
  const GaitConfig& gait() const noexcept { return *gait_; }

 private:
  double since_offset(std::size_t leg, double phase) const noexcept;

  const GaitConfig* gait_ = nullptr;
  std::size_t legs_ = 0;
  double phase_ = 0.0;
  bool holding_ = false;
  std::array<bool, kMostLegs> swinging_{};
  std::array<int, kMostLegs> steps_{};
};

}  // namespace sprung
