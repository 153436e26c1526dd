#pragma once
/// All that differs between makes of drive, behind one interface: what to configure, which PDOs, and how
/// their bytes become actuator-space values (output side of the gear, sign and offset applied; see
/// robots/robot_config.h) and back. Pure. Making a profile may throw; its noexcept methods run in the loop.
#include <cstdint>
#include <memory>
#include <vector>

#include "drivers/can/can_frame.h"
#include "drivers/canopen/protocol.h"
#include "robots/robot_config.h"
#include "signals/modes.h"

namespace sprung {

/// Times that drives must be told.
struct DriveTiming {
  double cycle_s = 0.0;
  double heartbeat_s = 0.0;           ///< period of the drive's own heartbeat
  double heartbeat_consumer_s = 0.0;  ///< the drive gives up on the bridge after this
};

/// One object to write at start-up and to read back.
struct DriveSetting {
  canopen::ObjectId object;
  int size = 0;  ///< bytes
  std::uint32_t value = 0;
  bool is_signed = false;  ///< how to show it to people
};

struct PdoSetting {
  bool transmit = false;  ///< seen from the drive
  int number = 0;         ///< from 0: TPDO1 is 0
  std::uint8_t transmission_type = canopen::kTypeEvent;
  std::vector<canopen::MapEntry> entries;  ///< empty = this PDO is disabled
  std::uint16_t event_timer_ms = 0;        ///< transmit by event: at least this often; 0 = on change only
};

/// What a drive says at SYNC.
struct DriveSample {
  double measured_position_rad = 0.0;
  double measured_current_A = 0.0;  ///< positive accelerates the actuator forward
  std::uint16_t status_word = 0;
};

/// Both set-points always travel, so that a change of mode finds its own already there.
struct DriveSetpoint {
  double commanded_torque_Nm =
      0.0;  ///< gear output side; saturated at what the frame and the drive's limit can hold
  double commanded_position_rad = 0.0;
  DriveMode mode = DriveMode::kTorque;  ///< kTorque or kPosition
};

class DriveProfile {
 public:
  virtual ~DriveProfile() = default;
  DriveProfile(const DriveProfile&) = delete;
  DriveProfile& operator=(const DriveProfile&) = delete;

  virtual std::vector<DriveSetting> settings() const = 0;
  /// Every PDO of the drive, so that none keeps a default that talks in between.
  virtual std::vector<PdoSetting> pdos() const = 0;
  virtual canopen::ObjectId supply_voltage_object() const noexcept = 0;
  virtual double supply_V(std::uint32_t raw) const noexcept = 0;

  /// @return false when the frame is not this drive's sample (other id or length).
  virtual bool decode_sample(const CanFrame& frame, DriveSample& sample) const noexcept = 0;
  /// @return false when the frame is not this drive's mode display.
  virtual bool decode_mode_display(const CanFrame& frame, std::int8_t& code) const noexcept = 0;
  /// kTorque or kPosition; kDisabled for modes that sprung does not use.
  virtual DriveMode shown_mode(std::int8_t code) const noexcept = 0;
  virtual CanFrame encode_setpoint(const DriveSetpoint& setpoint) const noexcept = 0;
  virtual CanFrame encode_control_word(std::uint16_t word) const noexcept = 0;

 protected:
  DriveProfile() = default;
};

/// The profile that the actuator names.
/// @throws std::invalid_argument on an unknown profile, naming it and those there are, and on values that the
/// drive's objects cannot hold.
std::unique_ptr<DriveProfile> make_profile(const ActuatorConfig& actuator, const DriveTiming& timing);

}  // namespace sprung
