#pragma once
/// CANopen on the wire (CiA 301): identifiers, NMT, expedited SDO for client and server, EMCY, heartbeat, PDO
/// map entries. Pure values, for the bridge and for the simulated drives alike. All multi-byte numbers are
/// little-endian. SDO transfers of more than 4 bytes (segmented, block) are not here: no object that sprung
/// uses needs them.
#include <cstdint>

#include "drivers/can/can_frame.h"

namespace sprung::canopen {

// Identifiers; + node id where one is added (CiA 301 predefined connection set).
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

// Little-endian; count 1, 2 or 4 bytes.
void put_le(std::uint8_t* bytes, std::uint32_t value, int count) noexcept;
std::uint32_t get_le(const std::uint8_t* bytes, int count) noexcept;

enum class NmtCommand : std::uint8_t {
  kStart = 0x01,
  kStop = 0x02,
  kEnterPreOperational = 0x80,
  kResetNode = 0x81,
  kResetCommunication = 0x82,
};

/// State byte of the heartbeat; kBootUp is sent once, when the node comes up.
enum class NmtState : std::uint8_t {
  kBootUp = 0x00,
  kStopped = 0x04,
  kOperational = 0x05,
  kPreOperational = 0x7F,
  kUnknown = 0xFF,  ///< none of the above, or nothing heard yet
};

/// @param node 1..127, 0 = all nodes.
CanFrame nmt_frame(NmtCommand command, int node) noexcept;
CanFrame sync_frame() noexcept;
CanFrame heartbeat_frame(int node, NmtState state) noexcept;
/// @return kUnknown for a frame of wrong length or value; bit 7 (node guarding) is ignored.
NmtState heartbeat_state(const CanFrame& frame) noexcept;

/// @return false when it is no NMT frame, its command is unknown, or it is for another node.
bool decode_nmt(const CanFrame& frame, int node, NmtCommand& command) noexcept;

/// One entry of an object dictionary.
struct ObjectId {
  std::uint16_t index = 0;
  std::uint8_t sub = 0;
  bool operator==(const ObjectId& other) const noexcept { return index == other.index && sub == other.sub; }
};

enum class SdoKind : std::uint8_t {
  kInvalid,   ///< not an SDO frame of this direction, or a service that is not expedited
  kUpload,    ///< request: read; reply: the value
  kDownload,  ///< request: write; reply: acknowledged
  kAbort,     ///< value holds the abort code
};

/// Request or reply; size is 1..4 bytes of value, 0 where there is no value (or its size was not told).
struct SdoMessage {
  SdoKind kind = SdoKind::kInvalid;
  ObjectId object;
  std::uint32_t value = 0;
  int size = 0;
};

// Client: request frames to `node`, and what its reply means.
CanFrame sdo_read_request(int node, ObjectId object) noexcept;
CanFrame sdo_write_request(int node, ObjectId object, std::uint32_t value, int size) noexcept;
CanFrame sdo_client_abort(int node, ObjectId object, std::uint32_t abort_code) noexcept;
SdoMessage decode_sdo_reply(const CanFrame& frame) noexcept;

// Server: what a request means, and reply frames of `node`.
SdoMessage decode_sdo_request(const CanFrame& frame) noexcept;
CanFrame sdo_read_reply(int node, ObjectId object, std::uint32_t value, int size) noexcept;
CanFrame sdo_write_reply(int node, ObjectId object) noexcept;
CanFrame sdo_server_abort(int node, ObjectId object, std::uint32_t abort_code) noexcept;

// Abort codes that sprung sends or expects (CiA 301 table 22).
inline constexpr std::uint32_t kAbortToggle = 0x05030000;
inline constexpr std::uint32_t kAbortTimeout = 0x05040000;
inline constexpr std::uint32_t kAbortCommand = 0x05040001;
inline constexpr std::uint32_t kAbortAccess = 0x06010000;
inline constexpr std::uint32_t kAbortWriteOnly = 0x06010001;
inline constexpr std::uint32_t kAbortReadOnly = 0x06010002;
inline constexpr std::uint32_t kAbortNoObject = 0x06020000;
inline constexpr std::uint32_t kAbortNotMappable = 0x06040041;
inline constexpr std::uint32_t kAbortMapTooLong = 0x06040042;
inline constexpr std::uint32_t kAbortParameter = 0x06040043;
inline constexpr std::uint32_t kAbortHardware = 0x06060000;
inline constexpr std::uint32_t kAbortLength = 0x06070010;
inline constexpr std::uint32_t kAbortTooLong = 0x06070012;
inline constexpr std::uint32_t kAbortTooShort = 0x06070013;
inline constexpr std::uint32_t kAbortNoSub = 0x06090011;
inline constexpr std::uint32_t kAbortRange = 0x06090030;
inline constexpr std::uint32_t kAbortTooHigh = 0x06090031;
inline constexpr std::uint32_t kAbortTooLow = 0x06090032;
inline constexpr std::uint32_t kAbortResource = 0x060A0023;
inline constexpr std::uint32_t kAbortGeneral = 0x08000000;
inline constexpr std::uint32_t kAbortStore = 0x08000020;
inline constexpr std::uint32_t kAbortDeviceState = 0x08000022;

/// What an abort code means, e.g. "no such object"; "unknown abort code" for others. Static text.
const char* abort_text(std::uint32_t abort_code) noexcept;

/// EMCY; code 0 means that the last error is gone.
struct Emergency {
  std::uint16_t code = 0;
  std::uint8_t error_register = 0;
};
CanFrame emergency_frame(int node, const Emergency& emergency) noexcept;
/// @return false on a frame shorter than its 8 bytes.
bool decode_emergency(const CanFrame& frame, Emergency& emergency) noexcept;
/// Meaning of an emergency code by CiA 301 / 402 class, e.g. "heartbeat lost". Static text.
const char* emergency_text(std::uint16_t code) noexcept;

// Flags in a PDO's COB-ID (sub 1 of its communication object).
inline constexpr std::uint32_t kPdoInvalid = 0x80000000;
inline constexpr std::uint32_t kPdoNoRtr = 0x40000000;  ///< transmit PDOs only
inline constexpr std::uint32_t kPdoExtended = 0x20000000;
inline constexpr std::uint32_t kPdoIdMask = 0x000007FF;
inline constexpr std::uint8_t kTypeEverySync = 1;
inline constexpr std::uint8_t kTypeEvent = 255;  ///< TPDO: on change; RPDO: applied on arrival

/// One object in a PDO.
struct MapEntry {
  ObjectId object;
  int bits = 0;  ///< 8, 16 or 32
};
constexpr std::uint32_t encode_map_entry(const MapEntry& entry) noexcept {
  return (static_cast<std::uint32_t>(entry.object.index) << 16) |
         (static_cast<std::uint32_t>(entry.object.sub) << 8) | static_cast<std::uint32_t>(entry.bits);
}
constexpr MapEntry decode_map_entry(std::uint32_t word) noexcept {
  return {{static_cast<std::uint16_t>(word >> 16), static_cast<std::uint8_t>((word >> 8) & 0xFF)},
          static_cast<int>(word & 0xFF)};
}

}  // namespace sprung::canopen
