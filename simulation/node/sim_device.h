#pragma once
/// Simulated nodes of the robot, whatever their make: what DriveTrain needs of them. Frames and times in,
/// frames and torques out; no clock, no allocation after construction.
#include <cstddef>
#include <cstdint>

#include "drivers/can/can_frame.h"
#include "robots/robot_config.h"
#include "signals/modes.h"
#include "simulation/node/motor_winding.h"
#include "simulation/node/motor_wiring.h"
#include "simulation/node/outbox.h"
#include "simulation/plant/sim_config.h"

namespace sprung::sim {

class SimDevice {
 public:
  virtual ~SimDevice() = default;
  SimDevice(const SimDevice&) = delete;
  SimDevice& operator=(const SimDevice&) = delete;

  Outbox& outbox() noexcept { return outbox_; }
  const Outbox& outbox() const noexcept { return outbox_; }
  /// SYNC must come after sample().
  virtual void receive(const CanFrame& frame, std::int64_t time_us) noexcept = 0;
  virtual bool operational() const noexcept = 0;
  /// Starts or ends (duration over, `on` false) a fault; kinds that this device does not know do nothing.
  /// Those that act on frames were given to the outbox before. @param value as FaultKind says.
  virtual void set_fault(FaultKind kind, double value, bool on) noexcept = 0;
  /// An emergency of any code, as from the device's own supervision: power off, state fault.
  virtual void raise_fault(std::uint16_t code) noexcept = 0;

 protected:
  explicit SimDevice(int bus) noexcept : outbox_(bus) {}

 private:
  Outbox outbox_;
};

/// Angles, speeds and torques are on the gear's output side, in the motor's own forward direction.
class SimDrive : public SimDevice {
 public:
  /// What the encoder and the current sensor show at a SYNC. @param cycle chooses the noise.
  virtual void sample(double shaft_rad, std::int64_t cycle) noexcept = 0;
  /// One tick of the drive's loops, `step_s` after the last one.
  virtual void step(double shaft_rad, std::int64_t time_us) noexcept = 0;
  /// The shaft was put elsewhere: no velocity follows from that.
  virtual void forget_motion() noexcept = 0;
  /// True torque of the motor behind its gear, before friction and rotor inertia.
  virtual double motor_torque_Nm() const noexcept = 0;
  virtual PowerState power_state() const noexcept = 0;
  /// What the motor takes from the supply; 0 where sim.yaml has no winding.
  virtual WindingState winding_state() const noexcept = 0;
  /// The robot's supply, from the next tick on.
  virtual void set_supply_V(double voltage_V) noexcept = 0;

 protected:
  using SimDevice::SimDevice;
};

/// Reads the link side of the gears of some actuators.
class SimCard : public SimDevice {
 public:
  /// What one channel's encoder sees at a SYNC: angle of the link, before direction and offset of robot.yaml.
  virtual void sample(int channel, double link_rad, std::int64_t cycle) noexcept = 0;
  virtual void step(std::int64_t time_us) noexcept = 0;

 protected:
  using SimDevice::SimDevice;
};

struct SimDriveSetup {
  ActuatorConfig actuator;  ///< node, bus, gear, encoder, ratings
  SimDriveConfig truth;
  double step_s = 0.0;  ///< of the drive's loops
  std::uint64_t seed = 0;
  std::uint64_t signal = 0;   ///< number of this drive's current noise
  DriveWiring wiring{};       ///< not given: the drive knows its motor
  bool real_winding = false;  ///< voltage limits the current; else it is only told
};

struct SimCardSetup {
  EncoderCardConfig card;
  std::uint64_t seed = 0;
  /// Of each channel's encoder; a channel beyond them has as many as the card can carry.
  std::vector<double> counts_per_turn{};
};

}  // namespace sprung::sim
