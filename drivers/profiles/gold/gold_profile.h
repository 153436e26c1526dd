#pragma once
/// Elmo Gold (EDS "CANeds Gold V002", facts canopen section 3): cyclic synchronous torque and position.
///
/// Scales. rated torque = Kt * rated current, as written to 0x6076 in whole mNm; torque set-point and torque
/// actual are per mille of it, at the motor. Per mille, mV and counts are the generic CiA 402 units
/// [unverified for Elmo].
///   motor torque = direction * torque_Nm / gear_ratio
///   current_A    = direction * per mille / 1000 * rated torque / Kt
///   position_rad = direction * counts * 2 pi / (counts per turn * gear ratio) + offset
#include "drivers/profiles/drive_profile.h"

namespace sprung::gold {

class GoldProfile final : public DriveProfile {
 public:
  GoldProfile(const ActuatorConfig& actuator, const DriveTiming& timing);

  KnownDevice known_device() const override;
  std::uint32_t required_modes() const noexcept override;
  std::vector<DriveSetting> settings() const override;
  /// Its maker's file limits 0x1016 to 65535, and says that the node id stands above: a drive may go by
  /// either.
  std::vector<DriveSetting> guarding_instead() const override;
  std::vector<PdoSetting> pdos() const override;
  CommissioningPlan commissioning(double bit_rate_bit_s) const override;
  canopen::ObjectId supply_voltage_object() const noexcept override;
  double supply_V(std::uint32_t raw) const noexcept override { return 1e-3 * raw; }
  canopen::MapEntry inputs() const noexcept override;
  bool decode_sample(const CanFrame& frame, DriveSample& sample) const noexcept override;
  DriveMode shown_mode(std::int8_t code) const noexcept override;
  CanFrame encode_setpoint(const DriveSetpoint& setpoint) const noexcept override;
  CanFrame encode_control_word(std::uint16_t word) const noexcept override;

 private:
  void add_speed_limit(std::vector<DriveSetting>& settings) const;
  ActuatorConfig actuator_;
  DriveTiming timing_;
  std::uint32_t rated_torque_mNm_ = 0;
  double rated_torque_Nm_ = 0.0;
  double counts_per_rad_ = 0.0;  ///< of the output, with the direction's sign
  int max_torque_permille_ = 0;  ///< of rated torque, for the actuator's torque limit (0x6072)
};

}  // namespace sprung::gold
