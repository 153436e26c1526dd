#pragma once
/// One simulated Elmo Gold drive with its motor: CANopen device, CiA 402 power stage, torque (CST) and
/// position (CSP) modes, current loop, encoder. Angles, speeds and torques are on the gear's output side, in
/// the motor's own forward direction.
#include <cstdint>

#include "drivers/cia402/words.h"
#include "drivers/sim/canopen_device.h"
#include "drivers/sim/motor_control.h"
#include "drivers/sim/sim_config.h"
#include "signals/modes.h"

namespace sprung::sim {

struct GoldDriveConfig {
  ActuatorConfig actuator;  ///< node, bus, gear, encoder, ratings
  SimDriveConfig truth;
  double step_s = 0.0;  ///< of the drive's loops
  std::uint64_t seed = 0;
  std::uint64_t signal = 0;  ///< number of this drive's current noise
};

class GoldDrive final : private DeviceApplication {
 public:
  explicit GoldDrive(const GoldDriveConfig& config);
  GoldDrive(const GoldDrive&) = delete;
  GoldDrive& operator=(const GoldDrive&) = delete;

  Outbox& outbox() noexcept { return outbox_; }
  /// SYNC must come after sample().
  void receive(const CanFrame& frame, std::int64_t time_us) noexcept { device_.receive(frame, time_us); }
  /// What the encoder and the current sensor show at a SYNC. @param cycle chooses the noise.
  void sample(double shaft_rad, std::int64_t cycle) noexcept;
  /// One tick of the drive's loops, `step_s` after the last one.
  void step(double shaft_rad, std::int64_t time_us) noexcept;

  /// The shaft was put elsewhere: no velocity follows from that.
  void forget_motion() noexcept { has_counts_ = false; }

  /// True torque of the motor behind its gear, before friction and rotor inertia.
  double motor_torque_Nm() const noexcept;
  bool operational() const noexcept { return device_.operational(); }
  PowerState power_state() const noexcept { return state_; }
  /// @param code CiA 301 / 402 error code, e.g. 0x2310 over-current: emergency, power off, state fault.
  void fault(std::uint16_t code) noexcept;

 private:
  void written(canopen::ObjectId id) noexcept override;
  void connection_lost() noexcept override;
  void connection_back() noexcept override;
  void reset() noexcept override;

  void control_word() noexcept;
  void quick_stop() noexcept;
  void advance_state() noexcept;
  void change_mode(double counts) noexcept;
  double desired_torque_Nm() noexcept;
  double position_torque_Nm() noexcept;
  void drive_motor() noexcept;
  void show_status() noexcept;
  void show_torque(std::int64_t cycle) noexcept;

  double object(std::uint16_t index, std::uint8_t sub = 0) const noexcept;
  void show(std::uint16_t index, double value) noexcept;
  double counts(double shaft_rad) const noexcept;
  double believed_constant_Nm_A() const noexcept;
  double per_mille_to_Nm(double per_mille) const noexcept;
  double interpolation_period_s() const noexcept;
  bool powered() const noexcept;

  GoldDriveConfig config_;
  ObjectDictionary dictionary_;
  Outbox outbox_;
  CanopenDevice device_;
  PositionLoop position_loop_;
  CurrentLoop current_loop_;
  PowerState state_ = PowerState::kNotReadyToSwitchOn;
  std::uint16_t last_control_word_ = 0;
  double counts_per_rad_ = 0.0;  ///< encoder counts per radian of the output
  double counts_ = 0.0;
  double velocity_rad_s_ = 0.0;
  bool position_active_ = false;
  bool limited_ = false;
  bool has_counts_ = false;
  std::int64_t cycle_ = -1;
  double quick_stop_s_ = 0.0;
};

}  // namespace sprung::sim
