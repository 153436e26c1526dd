#pragma once
/// One simulated Elmo Gold drive with its motor: torque (CST) and position (CSP) modes, in per mille of the
/// ratings (facts canopen 3).
#include <cstdint>

#include "simulation/node/cia402_drive.h"
#include "simulation/node/object_dictionary.h"

namespace sprung::sim {

/// Values that a real drive has from its commissioning.
struct GoldCommissioning {
  int node = 1;
  std::uint32_t revision = 0x000103F6;  ///< of "CANeds Gold V002"
  std::uint32_t serial = 1;
  std::uint32_t rated_current_mA = 0;
  std::uint32_t rated_torque_mNm = 0;     ///< motor side
  std::uint32_t max_motor_speed_rpm = 0;  ///< 0x6080
  std::uint32_t supply_mV = 0;
};

/// gold.eds, and what a real drive has from its commissioning.
ObjectDictionary gold_dictionary(const GoldCommissioning& commissioning);

/// Objects that canopen/objects.h does not name, since the bridge has no use for them.
inline constexpr std::uint16_t kDriveTemperature = 0x22A2;  ///< degC
inline constexpr std::uint16_t kTorqueDemand = 0x6074;      ///< per mille of rated torque
inline constexpr std::uint16_t kVelocityActual = 0x606C;    ///< counts/s
inline constexpr std::uint16_t kFollowingError = 0x60F4;    ///< counts

class GoldMake final : public DriveMake {
 public:
  explicit GoldMake(const SimDriveSetup& setup);

  ObjectDictionary& dictionary() noexcept override { return dictionary_; }
  ModeUse mode_use(std::int8_t code) const noexcept override;
  std::uint16_t position_object() const noexcept override;
  double interpolation_period_s() const noexcept override;
  double extrapolation_s() const noexcept override;
  DevicePolicy policy() const noexcept override;
  CurrentDemand demand(const DriveMoment& now) noexcept override;
  void show(const DriveMoment& now) noexcept override;
  std::uint16_t status_word(const PowerStage& stage, const DriveMoment& now) const noexcept override;

 private:
  double desired_torque_Nm(const DriveMoment& now) noexcept;
  double position_torque_Nm(const DriveMoment& now) noexcept;
  double object(std::uint16_t index, std::uint8_t sub = 0) const noexcept;
  void show(std::uint16_t index, double value) noexcept;
  double believed_constant_Nm_A() const noexcept;
  double per_mille_to_Nm(double per_mille) const noexcept;

  SimDriveSetup setup_;
  ObjectDictionary dictionary_;
};

class GoldDrive final : public Cia402Drive {
 public:
  explicit GoldDrive(const SimDriveSetup& setup) : Cia402Drive(setup, std::make_unique<GoldMake>(setup)) {}
};

}  // namespace sprung::sim
