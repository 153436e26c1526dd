#pragma once
/// A simulated CiA 402 drive with its motor, of any make: CANopen device, power states,
/// position and current loops, encoder, and the faults that can be asked of it.
#include <cstdint>
#include <memory>
#include <optional>

#include "simulation/node/canopen_device.h"
#include "simulation/node/motor_control.h"
#include "simulation/node/motor_encoder.h"
#include "simulation/node/motor_winding.h"
#include "simulation/node/motor_wiring.h"
#include "simulation/node/object_dictionary.h"
#include "simulation/node/power_stage.h"
#include "simulation/node/sim_device.h"

namespace sprung::sim {

/// What a mode of operation means for the loops.
enum class ModeUse : std::int8_t {
  kRefused,  ///< not simulated: 0x6060 aborts, 0x6061 stays
  kNone,     ///< no set-point: no current
  kCurrent,
  kPosition,  ///< set-points come once a cycle
  kVelocity,
  kProfilePosition,  ///< of these the make knows the reference itself
  kProfileVelocity,
};

/// One tick, as the drive sees itself.
struct DriveMoment {
  double counts = 0.0;  ///< of the motor's encoder
  double counts_at_index = 0.0;
  double velocity_rad_s = 0.0;
  double measured_current_A = 0.0;  ///< sensor's noise and offset included
  double supply_V = 0.0;
  double power_stage_degC = 0.0;
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

/// What differs between makes: their objects, units, modes and limits. Angles, speeds and torques are on the
/// gear's output side, in the motor's own forward direction.
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
  /// How long a position mode goes on without a new set-point, as fast as before; then it is a fault. 0: the
  /// last one stays, without end.
  virtual double extrapolation_s() const noexcept { return 0.0; }
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
  /// What its objects say of the motor; asked only of drives whose wiring is given.
  virtual MotorBelief motor_belief() const noexcept { return {}; }
  /// NMT reset node, power on.
  virtual void reset() noexcept {}

 protected:
  DriveMake() = default;
};

class Cia402Drive : public SimDrive, private DeviceApplication {
 public:
  Cia402Drive(const SimDriveSetup& setup, std::unique_ptr<DriveMake> make);

  void receive(const CanFrame& frame, std::int64_t time_us) noexcept override;
  void sample(double shaft_rad, std::int64_t cycle) noexcept override;
  void step(double shaft_rad, std::int64_t time_us) noexcept override;
  void forget_motion() noexcept override { has_counts_ = has_shaft_ = false; }
  double motor_torque_Nm() const noexcept override;
  bool operational() const noexcept override { return on_ && device_.operational(); }
  PowerState power_state() const noexcept override { return stage_.state(); }
  WindingState winding_state() const noexcept override { return winding_.state(current_A()); }
  void set_supply_V(double voltage_V) noexcept override { bus_V_ = voltage_V; }
  void set_fault(FaultKind kind, double value, bool on) noexcept override;
  void raise_fault(std::uint16_t code) noexcept override;

 private:
  std::uint32_t check_write(canopen::ObjectId id, std::int64_t value) noexcept override;
  void written(canopen::ObjectId id) noexcept override;
  void connection_lost() noexcept override;
  void connection_back() noexcept override;
  void reset() noexcept override;

  void control_word() noexcept;
  void change_mode() noexcept;
  void follow_mode() noexcept;
  void miss_setpoints() noexcept;
  void drive_motor() noexcept;
  double current_A() const noexcept;
  void switch_off_current() noexcept;
  void step_current(double target_A) noexcept;
  void commutate(double shaft_rad) noexcept;
  double seen_rad(double shaft_rad) const noexcept;
  void store(const DriveWiring& wiring) noexcept;
  void supervise() noexcept;
  void show(double counts) noexcept;
  void show_error_code(std::uint16_t code) noexcept;
  void tell_again() noexcept;
  void forget_communication_fault() noexcept;
  void switch_power(bool on) noexcept;
  void turn_winding(double shaft_rad) noexcept;
  bool lags_too_far() const noexcept;
  double supply_V() const noexcept { return forced_supply_V_.value_or(bus_V_); }
  double sensor_offset_A() const noexcept;
  bool extrapolates() const noexcept;
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
  GainedCurrentLoop gained_loop_;  ///< instead, where the wiring is given
  Commutation commutation_;        ///< the same
  MotorWinding winding_;
  double torque_share_ = 1.0;  ///< of Kt I that becomes torque
  double shaft_rad_ = 0.0;     ///< true one, at the last tick
  bool has_shaft_ = false;
  ModeUse mode_ = ModeUse::kNone;  ///< shown in 0x6061
  double mode_wait_s_ = 0.0;       ///< since another one was asked for
  double counts_ = 0.0;
  double velocity_rad_s_ = 0.0;
  bool has_counts_ = false;
  bool position_active_ = false;
  double since_setpoint_s_ = 0.0;  ///< while the position loop runs
  bool limited_ = false;
  bool on_ = true;                    ///< has its supply
  bool latches_ = false;              ///< communication faults, until NMT reset communication
  bool comes_up_in_fault_ = false;    ///< still to be done
  bool communication_fault_ = false;  ///< latched until NMT reset communication
  bool overheated_ = false;
  double noise_A_ = 0.0;                   ///< of the current sensor, in this cycle
  double bus_V_ = 0.0;                     ///< what the robot's supply gives
  std::optional<double> forced_supply_V_;  ///< instead, by a fault
  bool emergency_stop_ = false;            ///< at its input
  double current_offset_A_ = 0.0;          ///< of the sensor, by a fault
};

}  // namespace sprung::sim
