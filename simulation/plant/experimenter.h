#pragma once
/// SIM_CONTROL: what experiments do to the plant, the nodes and the buses, at the cycle they name.
#include <array>
#include <cstdint>

#include "signals/simulation.h"
#include "simulation/bus_faults.h"
#include "simulation/plant/drive_train.h"
#include "simulation/plant/imu_sensor.h"

namespace sprung::sim {

/// Meaning of SimControl by kind:
///   kWrench       wrench for duration_s; actuator -1 = on the base, n >= 0 = at the foot of leg n. It grows
///                 from what pushes there now in a straight line over the first `value` seconds of that; 0 =
///                 at once
///   kReset        plant to its initial pose at rest; drives keep their state; no wrench, not suspended
///   kSuspend      base held still; value > 0 = put at that height (m, world) first, 0 = let go, < 0 = held
///                 where it is
///   kDriveFault   emergency `value` (e.g. 0x3210; 0 = over-current 0x2310) of the actuator's drive
///   kDriveSilent  value 1 = cable of the actuator's drive cut (it neither hears nor speaks), 0 = mended
///   kNodeFault    `fault` with `value` of the actuator's drive or, with actuator -1, of every node of `bus`
///                 and of the bus itself; for duration_s of plant time, 0 = until mended. kNone mends all
///                 that was done to this target. A kPowerCycle of no duration is off and on again at once.
///   kFloor        floor to the height `value`, m, world; at once. actuator -1 = everywhere, n >= 0 = under
///                 leg n alone
///   kImu          see SimControlKind
class Experimenter {
 public:
  static constexpr std::size_t kCapacity = 64;
  Experimenter(DriveTrain& train, BusFaults& buses, ImuSensor& imu) noexcept
      : train_(train), buses_(buses), imu_(imu) {}
  /// @return false when too many are waiting or at work.
  bool add(const SimControl& control) noexcept;
  /// Does what is due, in the order in which it came; at a SYNC.
  void start_cycle(std::int64_t cycle) noexcept;
  /// Ends wrenches and faults whose time is over; after every step of the plant.
  void after_step() noexcept;

 private:
  struct Running {
    SimControl control;
    std::int64_t steps_left = 0;  ///< < 0: until mended
  };
  void act(const SimControl& control) noexcept;
  void push(const SimControl& control) noexcept;
  void apply_wrench(const std::array<double, 6>& wrench) noexcept;
  void keep_pushing() noexcept;
  void stop_pushing() noexcept;
  void begin_fault(const SimControl& control) noexcept;
  void switch_fault(const SimControl& control, bool on) noexcept;
  void mend(const SimControl& control) noexcept;
  std::int64_t steps(double duration_s) const noexcept;

  DriveTrain& train_;
  BusFaults& buses_;
  ImuSensor& imu_;
  std::array<SimControl, kCapacity> waiting_{};
  std::size_t count_ = 0;
  std::array<Running, kCapacity> running_{};
  std::size_t running_count_ = 0;
  int pushed_leg_ = -1;  ///< -1 = base
  std::array<double, 6> from_wrench_{}, to_wrench_{},
      wrench_{};  ///< of a push: at its start, when grown, now
  std::int64_t steps_done_ = 0, rise_steps_ = 0, steps_left_ = 0;
};

}  // namespace sprung::sim
