#pragma once
/// A scripted drive for tests of the bridge: an object dictionary that answers SDO, NMT states, a 402 machine
/// and samples. Not the product's simulated drive: no dynamics, but every answer can be bent.
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "drivers/can/can_frame.h"
#include "drivers/canopen/objects.h"
#include "drivers/canopen/protocol.h"
#include "robots/robot_config.h"
#include "signals/modes.h"

namespace sprung::test {

class FakeDrive {
 public:
  FakeDrive(int node, const IdentityConfig& identity);
  virtual ~FakeDrive() = default;

  /// What it answers at once is appended to `out`.
  void receive(const CanFrame& frame, std::vector<CanFrame>& out);
  /// Its own heartbeat, when switched on by 0x1017.
  void tick(std::int64_t time_us, std::vector<CanFrame>& out);
  /// As a drive does when it misses the master's heartbeat (0x6007) or its safe-torque-off input opens.
  void lose_power(PowerState to = PowerState::kSwitchOnDisabled) { power = to; }

  using Key = std::pair<std::uint16_t, std::uint8_t>;
  std::map<Key, std::uint32_t> objects;
  std::map<Key, std::uint32_t> clamped;       ///< objects that keep this value whatever is written
  std::map<Key, std::uint32_t> aborts;        ///< objects that answer with this abort code
  std::map<Key, std::uint32_t> write_aborts;  ///< the same, but they can be read
  std::vector<CanFrame> received;             ///< SDO requests and NMT commands to this node, in order
  canopen::NmtState nmt = canopen::NmtState::kPreOperational;
  PowerState power = PowerState::kSwitchOnDisabled;
  std::uint16_t control_word = 0;
  std::int32_t position_counts = 0;
  std::int16_t torque_permille = 0;
  std::int16_t target_torque_permille = 0;
  std::int32_t target_position_counts = 0;
  std::int8_t mode = 0;
  std::uint16_t pending_emergency = 0;  ///< sent at the next tick
  std::uint16_t passing_emergency = 0;  ///< sent at the next tick together with the frame that withdraws it
  bool restart_now = false;             ///< power cycle at the next tick: boot-up frame, settings gone
  bool dead = false;                    ///< neither hears nor speaks
  bool mute_samples = false;            ///< does not answer SYNC
  bool mute_heartbeat = false;
  bool mute_guarding = false;        ///< does not answer node guarding
  bool stuck_toggle = false;         ///< answers it with one and the same bit
  int guard_requests = 0;            ///< heard
  bool boots_silently = false;       ///< no boot-up frame
  bool stuck_in_quick_stop = false;  ///< never leaves it by itself
  bool stuck_in_fault = false;
  bool stuck_on = false;  ///< obeys neither control word nor NMT reset, but for losing the master's heartbeat
  bool reset_heals_stuck_fault = false;  ///< by reset communication
  bool loses_settings_on_reset = false;  ///< what SDO has written is gone after reset communication
  int resets = 0;
  int enabled_count = 0;           ///< transitions to operation enabled
  bool keeps_mode = false;         ///< does not switch modes any more
  bool mute_mode_display = false;  ///< its TPDO2 is lost

 protected:
  virtual void send_sample(std::vector<CanFrame>& out);
  int node() const { return node_; }

 private:
  void receive_nmt(canopen::NmtCommand command, std::vector<CanFrame>& out);
  void receive_sdo(const CanFrame& frame, std::vector<CanFrame>& out);
  void receive_pdo(const CanFrame& frame, std::vector<CanFrame>& out);
  void apply_control_word(std::uint16_t word);

  int node_;
  std::map<Key, std::uint32_t> defaults_;
  std::int64_t next_heartbeat_us_ = 0;
  bool toggle_ = false;  ///< of the next answer to node guarding
  int quick_stop_cycles_ = 0;
};

}  // namespace sprung::test
