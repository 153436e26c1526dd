#pragma once
/// One simulated maxon EPOS2 50/5 with its motor (facts canopen 2): modes -3 (current, mA), -1 (position,
/// qc), -2, 1 and 3 (epos2_motion_device.h), i2t, speed cap, following error, the 12 status words. Objects
/// are those of epos2.eds.
///
/// Not simulated: homing (6), interpolated position (7) and modes -4..-6, which an EPOS2 has: 0x6060 refuses
/// them with 06090030, so that nobody mistakes them for working. Neither are Hall sensors, analog and digital
/// inputs, auxiliary encoder. Beyond 0x607D a drive with power faults [unverified: in every mode, 0xFF09].
#include "drivers/profiles/epos2/epos2_motion_device.h"
#include "simulation/node/cia402_drive.h"

namespace sprung::sim {

class Epos2Make final : public DriveMake {
 public:
  // All [unverified], and so is that the drive averages like this.
  static constexpr PowerTimes kTimes{0.001, 0.002, 0.005, 0.020};
  static constexpr double kAverage_s = 0.010;       ///< 0x2027, 0x2028: first-order lag
  static constexpr double kTargetWindow_qc = 50.0;  ///< status bit 10 in position mode

  explicit Epos2Make(const SimDriveSetup& setup);

  ObjectDictionary& dictionary() noexcept override { return dictionary_; }
  ModeUse mode_use(std::int8_t code) const noexcept override;
  std::uint16_t position_object() const noexcept override;
  double interpolation_period_s() const noexcept override { return 1e-3; }  ///< 0x60C2 is fixed
  PowerTimes power_times() const noexcept override { return kTimes; }
  bool latches_communication_faults() const noexcept override { return true; }
  DevicePolicy policy() const noexcept override;
  CurrentDemand demand(const DriveMoment& now) noexcept override;
  void show(const DriveMoment& now) noexcept override;
  std::uint16_t status_word(const PowerStage& stage, const DriveMoment& now) const noexcept override;
  MotorBelief motor_belief() const noexcept override;
  void reset() noexcept override;

 private:
  double object(std::uint16_t index, std::uint8_t sub = 0) const noexcept;
  void show(std::uint16_t index, double value) noexcept;
  double desired_current_A(const DriveMoment& now) noexcept;
  double position_current_A(const PositionLoop::Reference& reference, const DriveMoment& now) noexcept;
  double limit_A(const DriveMoment& now) noexcept;
  bool beyond_limits(const DriveMoment& now) const noexcept;
  bool lags_too_far(const DriveMoment& now) const noexcept;
  void average(const DriveMoment& now) noexcept;

  SimDriveSetup setup_;
  ObjectDictionary dictionary_;
  ThermalLimit thermal_;
  bool warm_ = false;  ///< only the continuous current is allowed
  double rpm_per_rad_s_;
  Epos2Motion motion_;
  double average_current_A_ = 0.0;
  double average_rad_s_ = 0.0;
};

class Epos2Drive final : public Cia402Drive {
 public:
  explicit Epos2Drive(const SimDriveSetup& setup) : Cia402Drive(setup, std::make_unique<Epos2Make>(setup)) {}
};

}  // namespace sprung::sim
