#pragma once
/// All that differs between makes of drive, behind one interface: what to configure, which PDOs, and how
/// their bytes become actuator-space values (output side of the gear, sign and offset applied; see
/// robots/robot_config.h) and back. Pure. Making a profile may throw; its noexcept methods run in the loop.
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "drivers/can/can_frame.h"
#include "drivers/canopen/protocol.h"
#include "drivers/profiles/commissioning.h"
#include "robots/robot_config.h"
#include "signals/modes.h"

namespace sprung {

/// Times that drives must be told.
struct DriveTiming {
  double cycle_s = 0.0;
  double heartbeat_s = 0.0;           ///< period of the drive's own heartbeat
  double heartbeat_consumer_s = 0.0;  ///< the drive gives up on the bridge after this
  int lost_setpoints = 5;             ///< in a row that a drive has to bear
  /// The node is guarded, heartbeat_s apart, and gives up after the same time; make_profile() sets it as
  /// robot.yaml says.
  bool guarded = false;
};

/// What the bridge tells drives, and tools expect in them.
DriveTiming timing_of(double cycle_s, const WatchdogConfig& watchdogs) noexcept;

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
  std::uint16_t inhibit_100us = 0;         ///< transmit by event: at most this often; 0 = not written
};

/// What a drive says at SYNC.
struct DriveSample {
  double measured_position_rad = 0.0;
  double measured_current_A = 0.0;  ///< positive accelerates the actuator forward
  std::uint16_t status_word = 0;
};

/// Both set-points always travel, so that a change of mode finds its own already there.
struct DriveSetpoint {
  double commanded_torque_Nm = 0.0;  ///< gear output side; saturated at what the frame and the drive's limit
                                     ///< can hold
  double commanded_position_rad = 0.0;
  DriveMode mode = DriveMode::kTorque;  ///< kTorque or kPosition
};

/// Which devices a profile's objects were checked with: 0x1018 of the maker's files.
struct KnownDevice {
  std::uint32_t vendor = 0, product = 0;   ///< 0: of no maker, nothing is compared
  std::vector<std::uint32_t> revisions{};  ///< firmware, in the bits of revision_mask
  std::uint32_t revision_mask = 0xFFFFFFFF;
  /// Another firmware runs with what CiA 301 and 402 define, and the maker's own objects are left alone;
  /// else it is refused.
  bool standard_alone = false;

  bool knows_firmware(std::uint32_t revision) const noexcept {
    for (const std::uint32_t known : revisions)
      if (((revision ^ known) & revision_mask) == 0) return true;
    return false;
  }
};

/// 0x2000 to 0x5FFF: what an object means there, its maker alone says (CiA 301).
constexpr bool is_makers_own(std::uint16_t index) noexcept { return index >= 0x2000 && index < 0x6000; }

/// What every node needs: how to configure it.
class NodeProfile {
 public:
  virtual ~NodeProfile() = default;
  NodeProfile(const NodeProfile&) = delete;
  NodeProfile& operator=(const NodeProfile&) = delete;

  virtual KnownDevice known_device() const { return {}; }
  /// Modes that 0x6502 must show before the drive is used: bit n - 1 is mode n. 0: not read.
  virtual std::uint32_t required_modes() const noexcept { return 0; }
  virtual std::vector<DriveSetting> settings() const = 0;
  /// What is written instead where the node refuses the heartbeat consumer (0x1016): node guarding, by which
  /// it watches the bridge as well. Empty: it is refused.
  virtual std::vector<DriveSetting> guarding_instead() const { return {}; }
  /// Every PDO of the node, so that none keeps a default that talks in between.
  virtual std::vector<PdoSetting> pdos() const = 0;

 protected:
  NodeProfile() = default;
};

class DriveProfile : public NodeProfile {
 public:
  /// {0, 0} where the drive has none.
  virtual canopen::ObjectId supply_voltage_object() const noexcept = 0;
  virtual double supply_V(std::uint32_t raw) const noexcept = 0;
  /// The drive's digital inputs, which travel with its mode display where an emergency input is configured.
  virtual canopen::MapEntry inputs() const noexcept = 0;
  /// @return false when the frame does not carry them.
  bool decode_inputs(const CanFrame& frame, std::uint32_t& levels) const noexcept;
  /// Where the drive keeps its encoder's count at the last index pulse; {0, 0} where it does not.
  virtual canopen::ObjectId index_counter_object() const noexcept { return {}; }

  /// For `sprung drive commission`; empty where the make has no plan yet. Allocates.
  virtual CommissioningPlan commissioning(double /*bit_rate_bit_s*/) const { return {}; }

  /// @return false when the frame is not this drive's sample (other id or length).
  virtual bool decode_sample(const CanFrame& frame, DriveSample& sample) const noexcept = 0;
  /// @return false when the frame is not this drive's mode display.
  bool decode_mode_display(const CanFrame& frame, std::int8_t& code) const noexcept;
  /// kTorque or kPosition; kDisabled for modes that sprung does not use.
  virtual DriveMode shown_mode(std::int8_t code) const noexcept = 0;
  virtual CanFrame encode_setpoint(const DriveSetpoint& setpoint) const noexcept = 0;
  virtual CanFrame encode_control_word(std::uint16_t word) const noexcept = 0;

 protected:
  DriveProfile(int node, const EmergencyInputConfig& emergency) noexcept
      : node_(node), carries_inputs_(emergency.bit >= 0) {}
  /// Of the PDO that is sent on change: 0x6061, and the inputs where one of them stops.
  std::vector<canopen::MapEntry> display_entries() const;
  static constexpr std::uint8_t kDisplayPdo = 1;  ///< TPDO2

 private:
  bool is_display(const CanFrame& frame) const noexcept;

  int node_;
  bool carries_inputs_;
};

/// What an encoder card says at SYNC.
struct CardSample {
  static constexpr int kMaxChannels = 4;
  int channels = 0;
  std::array<std::uint32_t, kMaxChannels> counts{};
  std::uint8_t counter = 0;  ///< of the card's samples, modulo counter_modulus()
};

class CardProfile : public NodeProfile {
 public:
  /// @return false when the frame is not this card's sample (other id or length).
  virtual bool decode_sample(const CanFrame& frame, CardSample& sample) const noexcept = 0;
  virtual int channels() const noexcept = 0;
  virtual int counter_modulus() const noexcept = 0;

 protected:
  CardProfile() = default;
};

/// The profile that the actuator or card names.
/// @throws std::invalid_argument on an unknown profile, naming it and those there are, and on values that the
/// device's objects cannot hold.
std::unique_ptr<DriveProfile> make_profile(const ActuatorConfig& actuator, const DriveTiming& timing);
std::unique_ptr<CardProfile> make_card_profile(const EncoderCardConfig& card, const DriveTiming& timing);

}  // namespace sprung
