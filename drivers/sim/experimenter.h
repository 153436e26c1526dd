#pragma once
/// SIM_CONTROL: what experiments do to the plant and to the drives, at the cycle they name.
#include <array>
#include <cstdint>

#include "drivers/sim/drive_train.h"
#include "signals/signals.h"

namespace sprung::sim {

/// Meaning of SimControl by kind:
///   kWrench       wrench_on_base for duration_s; actuator -1 = on the base, n >= 0 = at the foot of leg n
///   instead kReset        plant to its initial pose at rest; drives keep their state; no wrench, not
///   suspended kSuspend      base held still; value > 0 = put at that height (m, world) first, 0 = let go, <
///   0 = held where it is kDriveFault   emergency `value` (e.g. 0x3210; 0 = over-current 0x2310) of the
///   actuator's drive kDriveSilent  value 1 = cable of the actuator's drive cut (it neither hears nor
///   speaks), 0 = mended
class Experimenter {
 public:
  static constexpr std::size_t kCapacity = 64;
  explicit Experimenter(DriveTrain& train) noexcept : train_(train) {}
  /// @return false when too many are waiting.
  bool add(const SimControl& control) noexcept;
  /// Does what is due, in the order in which it came; at a SYNC.
  void start_cycle(std::int64_t cycle) noexcept;
  /// Ends wrenches whose time is over; after every step of the plant.
  void after_step() noexcept;

 private:
  void act(const SimControl& control) noexcept;
  void push(const SimControl& control) noexcept;
  void stop_pushing() noexcept;

  DriveTrain& train_;
  std::array<SimControl, kCapacity> waiting_{};
  std::size_t count_ = 0;
  int pushed_leg_ = -1;  ///< -1 = base
  std::int64_t steps_left_ = 0;
};

}  // namespace sprung::sim
