#pragma once
/// What differs between makes of simulated CiA 402 drives (cia402_drive.h): their objects, units, modes and
/// limits. Angles, speeds and torques are on the gear's output side, in the motor's own forward direction.
#include <cstdint>

#include "simulation/node/canopen_device.h"
#include "simulation/node/motor_control.h"
#include "simulation/node/object_dictionary.h"
#include "simulation/node/power_stage.h"

namespace sprung::sim {

/// What a mode of operation means for the loops.
enum class ModeUse : std::int8_t {
  kRefused,  ///< not simulated: 0x6061 stays
  kNone,     ///< no set-point: no current
  kCurrent,
  kPosition,
};

/// One tick, as the drive sees itself.
struct DriveMoment {
  double counts = 0.0;  ///< of the motor's encoder
  double counts_at_index = 0.0;
  double velocity_rad_s = 0.0;
  double measured_current_A = 0.0;  ///< sensor's noise and offset included
  double supply_V = 0.0;
  double dt_s = 0.0;
  double counts_per_rad = 0.0;
  ModeUse mode = ModeUse::kNone;  ///< in force
  bool powered = false;
  bool braking = false;
  bool emergency_stop = false;        ///< at its input
  PositionLoop::Reference reference;  ///< only where mode is kPosition
};

struct CurrentDemand {
  bool on = false;  ///< false: no current at once
  double current_A = 0.0;
  bool limited = false;     ///< set-point was beyond a limit: status bit 11
  std::uint16_t fault = 0;  ///< the make's own supervision found this; 0 = nothing
};

class DriveMake {
 public:
  virtual ~DriveMake() = default;
  DriveMake(const DriveMake&) = delete;
  DriveMake& operator=(const DriveMake&) = delete;

  virtual ObjectDictionary& dictionary() noexcept = 0;
  virtual ModeUse mode_use(std::int8_t code) const noexcept = 0;
  /// Set-point of the position mode, counts.
  virtual std::uint16_t position_object() const noexcept = 0;
  /// Time in which the reference moves to a new set-point.
  virtual double interpolation_period_s() const noexcept = 0;
  /// 0x605A where the drive does not have it.
  virtual int quick_stop_option() const noexcept { return 2; }
  virtual PowerTimes power_times() const noexcept { return {}; }
  /// After heartbeat loss, bus off and the like a fault reset is ignored until NMT reset communication (facts
  /// canopen 2.5).
  virtual bool latches_communication_faults() const noexcept { return false; }
  virtual DevicePolicy policy() const noexcept { return {}; }
  /// Once a tick, also without power: set-point of the current loop within the limits.
  virtual CurrentDemand demand(const DriveMoment& now) noexcept = 0;
  /// Writes what the objects show; once a tick and at SYNC.
  virtual void show(const DriveMoment& now) noexcept = 0;
  /// Status word without bits 9 and 11.
  virtual std::uint16_t status_word(const PowerStage& stage, const DriveMoment& now) const noexcept = 0;
  /// NMT reset node, power on.
  virtual void reset() noexcept {}

 protected:
  DriveMake() = default;
};

}  // namespace sprung::sim
