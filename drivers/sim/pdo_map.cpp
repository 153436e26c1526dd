#include "drivers/sim/pdo_map.h"

#include "drivers/canopen/objects.h"

namespace sprung::sim {
namespace {

constexpr std::uint16_t kDummyU8 = 0x0005;  ///< the only one that a Gold has
constexpr int kMaxBits = 64;

struct PdoObject {
  PdoDirection direction = PdoDirection::kReceive;
  bool mapping = false;
  int n = -1;  ///< -1 = no PDO object
};

bool in_block(std::uint16_t index, std::uint16_t first) noexcept {
  return index >= first && index < first + canopen::kPdoCount;
}

PdoObject classify(std::uint16_t index) noexcept {
  if (in_block(index, canopen::kRpdoCommunication)) return {PdoDirection::kReceive, false, index & 0x1FF};
  if (in_block(index, canopen::kRpdoMapping)) return {PdoDirection::kReceive, true, index & 0x1FF};
  if (in_block(index, canopen::kTpdoCommunication)) return {PdoDirection::kTransmit, false, index & 0x1FF};
  if (in_block(index, canopen::kTpdoMapping)) return {PdoDirection::kTransmit, true, index & 0x1FF};
  return {};
}

canopen::ObjectId communication(PdoDirection direction, int n, int sub) noexcept {
  const auto base =
      direction == PdoDirection::kReceive ? canopen::kRpdoCommunication : canopen::kTpdoCommunication;
  return {static_cast<std::uint16_t>(base + n), static_cast<std::uint8_t>(sub)};
}

canopen::ObjectId mapping(PdoDirection direction, int n, int sub) noexcept {
  const auto base = direction == PdoDirection::kReceive ? canopen::kRpdoMapping : canopen::kTpdoMapping;
  return {static_cast<std::uint16_t>(base + n), static_cast<std::uint8_t>(sub)};
}

std::uint32_t read_u32(const ObjectDictionary& dictionary, canopen::ObjectId id) noexcept {
  return static_cast<std::uint32_t>(dictionary.get(id));
}

bool is_valid(const ObjectDictionary& dictionary, PdoDirection direction, int n) noexcept {
  return (read_u32(dictionary, communication(direction, n, 1)) & canopen::kPdoInvalid) == 0;
}

std::uint32_t check_entry(const ObjectDictionary& dictionary, PdoDirection direction,
                          std::uint32_t word) noexcept {
  const canopen::MapEntry entry = canopen::decode_map_entry(word);
  const bool receive = direction == PdoDirection::kReceive;
  if (receive && entry.object.index == kDummyU8) return entry.bits == 8 ? 0 : canopen::kAbortNotMappable;
  const int position = dictionary.find(entry.object);
  if (position < 0) return canopen::kAbortNoObject;
  const ObjectEntry& object = dictionary.entry(position);
  if (object.mappable != (receive ? Mappable::kReceive : Mappable::kTransmit))
    return canopen::kAbortNotMappable;
  return entry.bits == 8 * type_bytes(object.type) ? 0 : canopen::kAbortNotMappable;
}

std::uint32_t check_count(const ObjectDictionary& dictionary, const PdoObject& pdo,
                          std::uint32_t count) noexcept {
  if (count > 8) return canopen::kAbortMapTooLong;
  int bits = 0;
  for (int sub = 1; sub <= static_cast<int>(count); ++sub) {
    const std::uint32_t word = read_u32(dictionary, mapping(pdo.direction, pdo.n, sub));
    if (const std::uint32_t error = check_entry(dictionary, pdo.direction, word)) return error;
    bits += canopen::decode_map_entry(word).bits;
  }
  return bits > kMaxBits ? canopen::kAbortMapTooLong : 0;
}

std::uint32_t check_mapping(const ObjectDictionary& dictionary, const PdoObject& pdo, int sub,
                            std::uint32_t value) noexcept {
  if (is_valid(dictionary, pdo.direction, pdo.n)) return canopen::kAbortDeviceState;
  if (sub == 0) return check_count(dictionary, pdo, value);
  if (dictionary.get(mapping(pdo.direction, pdo.n, 0)) != 0) return canopen::kAbortDeviceState;
  return value == 0 ? 0 : check_entry(dictionary, pdo.direction, value);
}

std::uint32_t check_cob_id(const ObjectDictionary& dictionary, const PdoObject& pdo,
                           std::uint32_t value) noexcept {
  const std::uint32_t id = value & canopen::kPdoIdMask;
  if ((value & canopen::kPdoExtended) != 0 || id < 0x181 || id > 0x57F) return canopen::kAbortRange;
  const std::uint32_t old_id =
      read_u32(dictionary, communication(pdo.direction, pdo.n, 1)) & canopen::kPdoIdMask;
  const bool stays_valid = is_valid(dictionary, pdo.direction, pdo.n) && (value & canopen::kPdoInvalid) == 0;
  return stays_valid && id != old_id ? canopen::kAbortDeviceState : 0;
}

/// 0..240 by SYNC, 254 and 255 by event; RTR types are not simulated.
std::uint32_t check_type(std::uint32_t value) noexcept {
  return value <= 240 || value == 254 || value == 255 ? 0 : canopen::kAbortRange;
}

}  // namespace

bool configures_pdo(canopen::ObjectId id) noexcept { return classify(id.index).n >= 0; }

std::uint32_t check_pdo_write(const ObjectDictionary& dictionary, canopen::ObjectId id,
                              std::uint32_t value) noexcept {
  const PdoObject pdo = classify(id.index);
  if (pdo.n < 0 || dictionary.find(id) < 0) return 0;
  if (pdo.mapping) return check_mapping(dictionary, pdo, id.sub, value);
  if (id.sub == 1) return check_cob_id(dictionary, pdo, value);
  return id.sub == 2 ? check_type(value) : 0;
}

PdoMap resolve_pdo(const ObjectDictionary& dictionary, PdoDirection direction, int n) noexcept {
  PdoMap pdo;
  pdo.valid = is_valid(dictionary, direction, n);
  pdo.cob_id = read_u32(dictionary, communication(direction, n, 1)) & canopen::kPdoIdMask;
  pdo.type = static_cast<int>(dictionary.get(communication(direction, n, 2)));
  pdo.count = static_cast<int>(dictionary.get(mapping(direction, n, 0)));
  for (int i = 0; i < pdo.count; ++i) {
    const auto entry = canopen::decode_map_entry(read_u32(dictionary, mapping(direction, n, i + 1)));
    const auto slot = static_cast<std::size_t>(i);
    pdo.position[slot] = entry.object.index == kDummyU8 ? -1 : dictionary.find(entry.object);
    pdo.bytes[slot] = entry.bits / 8;
    pdo.length += pdo.bytes[slot];
  }
  return pdo;
}

}  // namespace sprung::sim
