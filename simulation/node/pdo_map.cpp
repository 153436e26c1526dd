#include "simulation/node/pdo_map.h"

#include "drivers/canopen/objects.h"

namespace sprung::sim {
namespace {

constexpr std::uint16_t kLastDummy = 0x0007;
constexpr std::uint8_t kInhibitSub = 3;
/// Bits of the dummies 0x0001..0x0007: boolean, i8, i16, i32, u8, u16, u32. No device here has 1-bit
/// granularity.
constexpr int kDummyBits[] = {0, 1, 8, 16, 32, 8, 16, 32};

bool in_block(std::uint16_t index, std::uint16_t first) noexcept {
  return index >= first && index < first + canopen::kPdoCount;
}

canopen::ObjectId communication(PdoDirection direction, int n, int sub) noexcept {
  const auto base = direction == PdoDirection::kReceive ? canopen::kRpdoCommunication
                                                        : canopen::kTpdoCommunication;
  return {static_cast<std::uint16_t>(base + n), static_cast<std::uint8_t>(sub)};
}

canopen::ObjectId mapping(PdoDirection direction, int n, int sub) noexcept {
  const auto base = direction == PdoDirection::kReceive ? canopen::kRpdoMapping : canopen::kTpdoMapping;
  return {static_cast<std::uint16_t>(base + n), static_cast<std::uint8_t>(sub)};
}

std::uint32_t read_u32(const ObjectDictionary& dictionary, canopen::ObjectId id) noexcept {
  return static_cast<std::uint32_t>(dictionary.get_or(id, 0));
}

bool is_valid(const ObjectDictionary& dictionary, PdoDirection direction, int n) noexcept {
  const int position = dictionary.find(communication(direction, n, 1));
  return position >= 0 && canopen::pdo_valid(static_cast<std::uint32_t>(dictionary.value(position)));
}

bool is_dummy(const ObjectDictionary& dictionary, PdoDirection direction, canopen::ObjectId id) noexcept {
  return direction == PdoDirection::kReceive && id.index <= kLastDummy && id.sub == 0 &&
         dictionary.has_dummy(id.index);
}

std::uint32_t check_entry(const ObjectDictionary& dictionary, PdoDirection direction,
                          std::uint32_t word) noexcept {
  const canopen::MapEntry entry = canopen::decode_map_entry(word);
  if (is_dummy(dictionary, direction, entry.object))
    return entry.bits == kDummyBits[entry.object.index] ? 0 : canopen::kAbortNotMappable;
  const int position = dictionary.find(entry.object);
  if (position < 0) return canopen::kAbortNoObject;
  const ObjectEntry& object = dictionary.entry(position);
  const bool receive = direction == PdoDirection::kReceive;
  const bool mappable = receive ? receivable(object.mappable) : transmittable(object.mappable);
  return mappable && entry.bits == 8 * canopen::type_bytes(object.type) ? 0 : canopen::kAbortNotMappable;
}

std::uint32_t check_count(const ObjectDictionary& dictionary, const PdoObject& pdo,
                          std::uint32_t count) noexcept {
  if (count > canopen::kMaxMapped) return canopen::kAbortMapTooLong;
  int bits = 0;
  for (int sub = 1; sub <= static_cast<int>(count); ++sub) {
    const std::uint32_t word = read_u32(dictionary, mapping(pdo.direction, pdo.n, sub));
    if (const std::uint32_t error = check_entry(dictionary, pdo.direction, word)) return error;
    bits += canopen::decode_map_entry(word).bits;
  }
  return bits > canopen::kPdoBits ? canopen::kAbortMapTooLong : 0;
}

std::uint32_t check_mapping(const ObjectDictionary& dictionary, const PdoObject& pdo, int sub,
                            std::uint32_t value) noexcept {
  if (is_valid(dictionary, pdo.direction, pdo.n)) return canopen::kAbortDeviceState;
  if (sub == 0) return check_count(dictionary, pdo, value);
  if (dictionary.get(mapping(pdo.direction, pdo.n, 0)) != 0) return canopen::kAbortDeviceState;
  return value == 0 ? 0 : check_entry(dictionary, pdo.direction, value);
}

/// A PDO that is switched off may carry any identifier of 11 bits: masters switch off with 0x80000000.
std::uint32_t check_cob_id(const ObjectDictionary& dictionary, const PdoObject& pdo,
                           std::uint32_t value) noexcept {
  if ((value & canopen::kPdoExtended) != 0 || !canopen::pdo_cob_id_allowed(value))
    return canopen::kAbortRange;
  const std::uint32_t old_id = read_u32(dictionary, communication(pdo.direction, pdo.n, 1)) &
                               canopen::kPdoIdMask;
  const bool stays_valid = is_valid(dictionary, pdo.direction, pdo.n) && canopen::pdo_valid(value);
  return stays_valid && (value & canopen::kPdoIdMask) != old_id ? canopen::kAbortDeviceState : 0;
}

std::uint32_t check_type(PdoDirection direction, std::uint32_t value) noexcept {
  const int type = static_cast<int>(value);
  const bool known = type == canopen::kTypeSyncOnChange ||
                     canopen::pdo_type_supported(type, direction == PdoDirection::kTransmit);
  return known ? 0 : canopen::kAbortRange;
}

std::uint32_t check_communication(const ObjectDictionary& dictionary, const PdoObject& pdo, int sub,
                                  std::uint32_t value) noexcept {
  if (sub == 1) return check_cob_id(dictionary, pdo, value);
  if (sub == 2) return check_type(pdo.direction, value);
  const bool needs_invalid = sub == kInhibitSub && pdo.direction == PdoDirection::kTransmit;
  return needs_invalid && is_valid(dictionary, pdo.direction, pdo.n) ? canopen::kAbortDeviceState : 0;
}

}  // namespace

PdoObject pdo_object(std::uint16_t index) noexcept {
  const int n = index & 0x1FF;
  if (in_block(index, canopen::kRpdoCommunication)) return {PdoDirection::kReceive, false, n};
  if (in_block(index, canopen::kRpdoMapping)) return {PdoDirection::kReceive, true, n};
  if (in_block(index, canopen::kTpdoCommunication)) return {PdoDirection::kTransmit, false, n};
  if (in_block(index, canopen::kTpdoMapping)) return {PdoDirection::kTransmit, true, n};
  return {};
}

std::uint32_t check_pdo_write(const ObjectDictionary& dictionary, canopen::ObjectId id,
                              std::uint32_t value) noexcept {
  const PdoObject pdo = pdo_object(id.index);
  if (pdo.n < 0 || !dictionary.has(id)) return 0;
  return pdo.mapping ? check_mapping(dictionary, pdo, id.sub, value)
                     : check_communication(dictionary, pdo, id.sub, value);
}

PdoMap resolve_pdo(const ObjectDictionary& dictionary, PdoDirection direction, int n) noexcept {
  PdoMap pdo;
  pdo.valid = is_valid(dictionary, direction, n);
  const std::uint32_t cob_id = read_u32(dictionary, communication(direction, n, 1));
  pdo.cob_id = cob_id & canopen::kPdoIdMask;
  pdo.answers_remote = direction == PdoDirection::kTransmit && canopen::pdo_answers_remote(cob_id);
  pdo.type = static_cast<int>(dictionary.get_or(communication(direction, n, 2), canopen::kTypeEvent));
  pdo.count = static_cast<int>(dictionary.get_or(mapping(direction, n, 0), 0));
  for (int i = 0; i < pdo.count; ++i) {
    const auto entry = canopen::decode_map_entry(read_u32(dictionary, mapping(direction, n, i + 1)));
    const auto slot = static_cast<std::size_t>(i);
    pdo.position[slot] = dictionary.find(entry.object);  // -1 for dummies
    pdo.bytes[slot] = entry.bits / 8;
    pdo.length += pdo.bytes[slot];
  }
  return pdo;
}

}  // namespace sprung::sim
