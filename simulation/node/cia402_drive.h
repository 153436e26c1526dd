#pragma once
/// A simulated CiA 402 drive with its motor, of any make (drive_make.h): CANopen device, power states,
/// position and current loops, encoder, and the faults that can be asked of it.
#include <cstdint>
#include <memory>

#include "simulation/node/canopen_device.h"
#include "simulation/node/drive_make.h"
#include "simulation/node/motor_control.h"
#include "simulation/node/motor_encoder.h"
#include "simulation/node/power_stage.h"
#include "simulation/node/sim_device.h"

namespace sprung::sim {

class Cia402Drive : public SimDrive, private DeviceApplication {
 public:
  Cia402Drive(const SimDriveSetup& setup, std::unique_ptr<DriveMake> make);

  void receive(const CanFrame& frame, std::int64_t time_us) noexcept override;
  void sample(double shaft_rad, std::int64_t cycle) noexcept override;
  void step(double shaft_rad, std::int64_t time_us) noexcept override;
  void forget_motion() noexcept override { has_counts_ = false; }
  double motor_torque_Nm() const noexcept override;
  bool operational() const noexcept override { return on_ && device_.operational(); }
  PowerState power_state() const noexcept override { return stage_.state(); }
  void set_fault(FaultKind kind, double value, bool on) noexcept override;
  void raise_fault(std::uint16_t code) noexcept override;

 private:
  void written(canopen::ObjectId id) noexcept override;
  void connection_lost() noexcept override;
  void connection_back() noexcept override;
  void reset() noexcept override;

  void control_word() noexcept;
  void change_mode() noexcept;
  void follow_mode() noexcept;
  void drive_motor() noexcept;
  void supervise() noexcept;
  void show(double counts) noexcept;
  void show_error_code(std::uint16_t code) noexcept;
  void tell_again() noexcept;
  void forget_communication_fault() noexcept;
  void switch_power(bool on) noexcept;
  double smoothing_s() const noexcept;
  double sensor_noise_A(std::int64_t cycle) const noexcept;
  bool supply_is_bad() const noexcept;
  bool fault_may_be_reset() const noexcept;
  PowerOptions options() const noexcept;
  int option(std::uint16_t index, int otherwise) const noexcept;
  DriveMoment moment(double counts) const noexcept;

  SimDriveSetup setup_;
  std::unique_ptr<DriveMake> make_;
  ObjectDictionary& dictionary_;  ///< the make's
  CanopenDevice device_;
  PowerStage stage_;
  MotorEncoder encoder_;
  PositionLoop position_loop_;
  PositionLoop::Reference reference_;
  CurrentLoop current_loop_;
  ModeUse mode_ = ModeUse::kNone;  ///< shown in 0x6061
  double mode_wait_s_ = 0.0;       ///< since another one was asked for
  double counts_ = 0.0;
  double velocity_rad_s_ = 0.0;
  bool has_counts_ = false;
  bool position_active_ = false;
  bool limited_ = false;
  bool on_ = true;                    ///< has its supply
  bool latches_ = false;              ///< communication faults, until NMT reset communication
  bool comes_up_in_fault_ = false;    ///< still to be done
  bool communication_fault_ = false;  ///< latched until NMT reset communication
  bool overheated_ = false;
  double noise_A_ = 0.0;  ///< of the current sensor, in this cycle
  double supply_V_ = 0.0;
  bool emergency_stop_ = false;    ///< at its input
  double current_offset_A_ = 0.0;  ///< of the sensor
};

}  // namespace sprung::sim
