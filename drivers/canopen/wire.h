#pragma once
/// What every CANopen service shares: identifiers of the predefined connection set (CiA 301, facts canopen
/// 1.1), names of dictionary entries, little-endian numbers. Pure values.
#include <cstdint>

#include "drivers/can/can_frame.h"

namespace sprung::canopen {

// Identifiers; + node id where one is added. Lower identifiers win arbitration.
inline constexpr std::uint32_t kNmtId = 0x000;
inline constexpr std::uint32_t kSyncId = 0x080;
inline constexpr std::uint32_t kEmcyBase = 0x080;
inline constexpr std::uint32_t kTpdoBase = 0x180;       ///< + 0x100 * n, n from 0
inline constexpr std::uint32_t kRpdoBase = 0x200;       ///< + 0x100 * n, n from 0
inline constexpr std::uint32_t kSdoServerBase = 0x580;  ///< server to client
inline constexpr std::uint32_t kSdoClientBase = 0x600;  ///< client to server
inline constexpr std::uint32_t kHeartbeatBase = 0x700;
inline constexpr int kMaxNode = 127;
inline constexpr int kBridgeNode = 127;  ///< the bridge's own heartbeat [design choice]
inline constexpr int kPdoCount = 4;      ///< of each direction on a Gold and on an EPOS2

constexpr std::uint32_t emcy_id(int node) noexcept { return kEmcyBase + static_cast<std::uint32_t>(node); }
constexpr std::uint32_t sdo_server_id(int node) noexcept {
  return kSdoServerBase + static_cast<std::uint32_t>(node);
}
constexpr std::uint32_t sdo_client_id(int node) noexcept {
  return kSdoClientBase + static_cast<std::uint32_t>(node);
}
constexpr std::uint32_t heartbeat_id(int node) noexcept {
  return kHeartbeatBase + static_cast<std::uint32_t>(node);
}
/// @param n PDO number from 0: tpdo_id(0, 1) is TPDO1 of node 1, 0x181.
constexpr std::uint32_t tpdo_id(int n, int node) noexcept {
  return kTpdoBase + 0x100U * static_cast<std::uint32_t>(n) + static_cast<std::uint32_t>(node);
}
constexpr std::uint32_t rpdo_id(int n, int node) noexcept {
  return kRpdoBase + 0x100U * static_cast<std::uint32_t>(n) + static_cast<std::uint32_t>(node);
}

/// One entry of an object dictionary.
struct ObjectId {
  std::uint16_t index = 0;
  std::uint8_t sub = 0;
  bool operator==(const ObjectId& other) const noexcept { return index == other.index && sub == other.sub; }
};

// Little-endian; count 1..4 bytes.
void put_le(std::uint8_t* bytes, std::uint32_t value, int count) noexcept;
std::uint32_t get_le(const std::uint8_t* bytes, int count) noexcept;

CanFrame sync_frame() noexcept;

}  // namespace sprung::canopen
