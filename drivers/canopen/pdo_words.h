#pragma once
/// What the PDO communication and mapping objects (0x1400, 0x1600, 0x1800, 0x1A00) say, word by word (CiA
/// 301, facts canopen 1.1 and 1.5). Pure values, for a master that writes them and a device that obeys them.
#include <cstdint>

#include "drivers/canopen/wire.h"

namespace sprung::canopen {

// Flags in a PDO's COB-ID (sub 1 of its communication object).
inline constexpr std::uint32_t kPdoInvalid = 0x80000000;
inline constexpr std::uint32_t kPdoNoRtr = 0x40000000;  ///< transmit PDOs only
inline constexpr std::uint32_t kPdoExtended = 0x20000000;
inline constexpr std::uint32_t kPdoIdMask = 0x000007FF;

constexpr bool pdo_valid(std::uint32_t cob_id) noexcept { return (cob_id & kPdoInvalid) == 0; }
/// Whether a PDO may be moved to this identifier: 0x181..0x57F; all others belong to services that cannot be
/// moved ([U] CiA 301, facts canopen 1.1).
constexpr bool pdo_id_allowed(std::uint32_t id) noexcept { return id >= 0x181 && id <= 0x57F; }
/// Whether a device can take this COB-ID as a whole: an 11-bit identifier that is allowed. One that disables
/// the PDO may carry any identifier.
constexpr bool pdo_cob_id_allowed(std::uint32_t cob_id) noexcept {
  if (!pdo_valid(cob_id)) return true;
  return (cob_id & kPdoExtended) == 0 && pdo_id_allowed(cob_id & 0x1FFFFFFF);
}

// Transmission types (sub 2).
inline constexpr std::uint8_t kTypeSyncOnChange = 0;  ///< TPDO: at the next SYNC after a change
inline constexpr std::uint8_t kTypeEverySync = 1;
inline constexpr std::uint8_t kTypeSyncMax = 240;  ///< TPDO: every n-th SYNC; RPDO: applied at the next SYNC
inline constexpr std::uint8_t kTypeRemoteSync = 252;  ///< TPDO: when asked for, as it was at the last SYNC
inline constexpr std::uint8_t kTypeRemote = 253;      ///< TPDO: when asked for, as it is then
inline constexpr std::uint8_t kTypeEventMaker = 254;
inline constexpr std::uint8_t kTypeEvent = 255;  ///< TPDO: on change; RPDO: applied on arrival

/// 1..240: bound to SYNC, every n-th one.
constexpr bool is_sync_type(int type) noexcept { return type >= kTypeEverySync && type <= kTypeSyncMax; }
constexpr bool is_event_type(int type) noexcept { return type == kTypeEventMaker || type == kTypeEvent; }
/// Sent when a remote frame asks for it, and only then.
constexpr bool is_remote_type(int type) noexcept { return type == kTypeRemoteSync || type == kTypeRemote; }
/// What our devices offer but 0 (SYNC, on change): 1..240, 254, 255, and for a TPDO 252 and 253. Not 241..251
/// (reserved). A real EPOS2 may take fewer ([U] facts canopen 1.5).
constexpr bool pdo_type_supported(int type, bool transmit) noexcept {
  return is_sync_type(type) || is_event_type(type) || (transmit && is_remote_type(type));
}
/// Whether a remote frame may ask for this TPDO, whatever its type.
constexpr bool pdo_answers_remote(std::uint32_t cob_id) noexcept { return (cob_id & kPdoNoRtr) == 0; }

/// Inhibit time (sub 3): least time between two PDOs of event type.
inline constexpr std::int64_t kInhibitUnit_us = 100;
constexpr std::int64_t inhibit_us(std::uint16_t units) noexcept { return units * kInhibitUnit_us; }

inline constexpr int kMaxMapped = 8;  ///< objects in a PDO on an EPOS2 and a Gold
inline constexpr int kPdoBits = 64;

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
