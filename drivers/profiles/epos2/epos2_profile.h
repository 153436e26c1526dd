#pragma once
/// maxon EPOS2 50/5 (facts canopen section 2): its own modes for current (-3) and position (-1), since it has
/// no cyclic synchronous ones.
///
/// Scales. Currents in mA, positions in qc = quadrature counts of the motor's encoder (`encoder_counts` of
/// robot.yaml, 4 for each pulse).
///   current_mA   = direction * torque_Nm / (gear_ratio * Kt) * 1000
///   position_rad = direction * qc * 2 pi / (qc per turn * gear_ratio) + offset
#include "drivers/profiles/drive_profile.h"

namespace sprung::epos2 {

class Epos2Profile final : public DriveProfile {
 public:
  /// @throws std::invalid_argument on values beyond the drive's own limits: 5 A continuous, 10 A peak, 16 to
  /// 2 500 000 pulses, 25 000 rpm.
  Epos2Profile(const ActuatorConfig& actuator, const DriveTiming& timing);

  KnownDevice known_device() const override;
  std::vector<DriveSetting> settings() const override;
  std::vector<PdoSetting> pdos() const override;
  CommissioningPlan commissioning(double bit_rate_bit_s) const override;
  /// None: the data sheets at hand show no supply voltage.
  canopen::ObjectId supply_voltage_object() const noexcept override { return {0, 0}; }
  double supply_V(std::uint32_t raw) const noexcept override;
  canopen::ObjectId index_counter_object() const noexcept override { return {0x2021, 0}; }
  canopen::MapEntry inputs() const noexcept override;
  bool decode_sample(const CanFrame& frame, DriveSample& sample) const noexcept override;
  DriveMode shown_mode(std::int8_t code) const noexcept override;
  CanFrame encode_setpoint(const DriveSetpoint& setpoint) const noexcept override;
  CanFrame encode_control_word(std::uint16_t word) const noexcept override;

 private:
  void add_motor(std::vector<DriveSetting>& settings) const;
  void add_position_loop(std::vector<DriveSetting>& settings) const;
  ActuatorConfig actuator_;
  DriveTiming timing_;
  double mA_per_Nm_ = 0.0;   ///< of torque at the gear's output, without the direction's sign
  double qc_per_rad_ = 0.0;  ///< of the output, without the direction's sign
  int peak_current_mA_ = 0;  ///< that stands for the actuator's torque limit (0x6410:02)
};

}  // namespace sprung::epos2
