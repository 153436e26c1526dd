#pragma once
/// One simulated Elmo Gold drive with its motor: CANopen device, CiA 402 power stage, torque (CST) and
/// position (CSP) modes, current loop, encoder. Angles, speeds and torques are on the gear's output side, in
/// the motor's own forward direction.
#include <cstdint>

#include "drivers/cia402/words.h"
#include "drivers/sim/canopen_device.h"
#include "drivers/sim/motor_control.h"
#include "drivers/sim/sim_device.h"
#include "signals/modes.h"

namespace sprung::sim {

class GoldDrive final : public SimDrive, private DeviceApplication {
 public:
  explicit GoldDrive(const SimDriveSetup& config);

  void receive(const CanFrame& frame, std::int64_t time_us) noexcept override {
    device_.receive(frame, time_us);
  }
  void sample(double shaft_rad, std::int64_t cycle) noexcept override;
  void step(double shaft_rad, std::int64_t time_us) noexcept override;
  void forget_motion() noexcept override { has_counts_ = false; }
  double motor_torque_Nm() const noexcept override;
  bool operational() const noexcept override { return device_.operational(); }
  PowerState power_state() const noexcept override { return state_; }
  void set_fault(FaultKind kind, double value, bool on) noexcept override;
  void raise_fault(std::uint16_t code) noexcept override;

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

  SimDriveSetup config_;
  ObjectDictionary dictionary_;
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
