#pragma once
/// Layer setting services (CiA 305): how a device without a node id, or with another device's, gets one, and
/// its bit rate. Frames of master and slave, byte for byte; every one has 8 bytes. Pure values.
#include <array>
#include <cstdint>

#include "drivers/canopen/wire.h"

namespace sprung::canopen {

inline constexpr std::uint32_t kLssMasterId = 0x7E5;  ///< master to slaves
inline constexpr std::uint32_t kLssSlaveId = 0x7E4;   ///< slaves to master
inline constexpr int kNoNode = 0xFF;                  ///< of a device that has no node id yet

/// Object 0x1018: :01 vendor, :02 product, :03 revision, :04 serial number. The four together are one device
/// in the world.
using LssIdentity = std::array<std::uint32_t, 4>;

enum class LssMode : std::uint8_t { kWaiting = 0, kConfiguration = 1 };

/// First byte of a frame, of requests and of those replies that repeat it.
enum class LssCommand : std::uint8_t {
  kSwitchAll = 0x04,         ///< byte 1: LssMode; no reply
  kConfigureNode = 0x11,     ///< byte 1: node id
  kConfigureBitRate = 0x13,  ///< byte 1: table (0 = CiA 301), byte 2: index in it
  kActivateBitRate = 0x15,   ///< bytes 1-2: ms before and after the switch; no reply
  kStore = 0x17,
  kSelectVendor = 0x40,  ///< .. 0x43, number by number; the device that has all four answers kSelected
  kSelectSerial = 0x43,
  kSelected = 0x44,
  kIdentified = 0x4F,  ///< reply to fastscan
  kFastscan = 0x51,
  kInquireVendor = 0x5A,  ///< .. 0x5D, number by number
  kInquireSerial = 0x5D,
  kInquireNode = 0x5E,
};

/// One question of a fastscan: has a device without node id a number `part` (0 vendor .. 3 serial) whose bits
/// from `bit` up are those of `number`?
struct LssQuestion {
  static constexpr int kAnyone = 0x80;  ///< instead of a bit: is there anybody, whatever its numbers?
  std::uint32_t number = 0;
  int bit = kAnyone;
  int part = 0;
  int next = 0;  ///< the part that is asked for next, by those who say yes
};

/// Index of a bit rate in the table of CiA 301. @return -1 where it has none.
int lss_bit_rate_index(int kbit_s) noexcept;
/// The other way. @return 0 for a reserved index.
int lss_bit_rate_kbit_s(int index) noexcept;

CanFrame lss_request(LssCommand command, std::uint8_t byte1 = 0, std::uint8_t byte2 = 0) noexcept;
/// kSelectVendor..kSelectSerial. @param part 0..3.
CanFrame lss_select_request(int part, std::uint32_t number) noexcept;
CanFrame lss_fastscan_request(const LssQuestion& question) noexcept;
LssQuestion decode_lss_question(const CanFrame& request) noexcept;

/// @param value bytes 1-4: a number that was inquired, or error code and maker's error code.
CanFrame lss_reply(LssCommand command, std::uint32_t value = 0) noexcept;

bool is_lss_request(const CanFrame& frame) noexcept;
bool is_lss_reply(const CanFrame& frame) noexcept;
constexpr LssCommand lss_command(const CanFrame& frame) noexcept {
  return static_cast<LssCommand>(frame.data[0]);
}
/// The name of a command, and of a reply that repeats it, e.g. "configure node id". Static text.
const char* lss_text(LssCommand command) noexcept;

}  // namespace sprung::canopen
