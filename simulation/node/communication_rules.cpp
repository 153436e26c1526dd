#include "simulation/node/communication_rules.h"

#include "drivers/canopen/objects.h"
#include "drivers/canopen/pdo_words.h"

namespace sprung::sim {
namespace {

struct Range {
  std::uint16_t first;
  std::uint16_t last;
};

/// Of 0x1010 and 0x1011 by sub-index (CiA 301): all, communication, application.
constexpr Range kAll{0x1000, 0xFFFF};
constexpr Range kCommunication{0x1000, 0x1FFF};
constexpr Range kApplication{0x6000, 0x9FFF};
constexpr std::uint8_t kPdoIdsSub = 5;  ///< maxon's own: PDO identifiers

constexpr Range kRestricted[] = {{0x000, 0x07F}, {0x101, 0x180}, {0x581, 0x5FF},
                                 {0x601, 0x67F}, {0x6E0, 0x6FF}, {0x701, 0x7FF}};

Range range_of(std::uint8_t sub) noexcept {
  if (sub == 2) return kCommunication;
  return sub == 3 ? kApplication : kAll;
}

std::uint32_t check_emergency_id(const ObjectDictionary& dictionary, canopen::ObjectId id,
                                 std::int64_t value) noexcept {
  const auto cob_id = static_cast<std::uint32_t>(value);
  const auto old = static_cast<std::uint32_t>(dictionary.get(id));
  const std::uint32_t frame_id = cob_id & 0x3FFFFFFF;  // bit 30 is reserved, bit 29 = extended
  if (frame_id > 0x7FF || restricted_id(frame_id)) return canopen::kAbortRange;
  const bool stays_valid = canopen::pdo_valid(old) && canopen::pdo_valid(cob_id);
  return stays_valid && old != cob_id ? canopen::kAbortDeviceState : 0;
}

std::uint32_t check_consumer(const ObjectDictionary& dictionary, canopen::ObjectId id,
                             std::int64_t value) noexcept {
  const std::int64_t node = value >> 16;
  if (node == 0 || (value & 0xFFFF) == 0) return 0;  // switched off
  if (node > canopen::kMaxNode) return canopen::kAbortRange;
  for (std::uint8_t sub = 1; dictionary.has({id.index, sub}); ++sub) {
    const std::int64_t other = dictionary.get({id.index, sub});
    if (sub != id.sub && (other >> 16) == node && (other & 0xFFFF) != 0) return canopen::kAbortParameter;
  }
  return 0;
}

void forget_pdo_ids(ObjectDictionary& dictionary) noexcept {
  for (const std::uint16_t base : {canopen::kRpdoCommunication, canopen::kTpdoCommunication}) {
    for (int n = 0; n < canopen::kPdoCount; ++n) {
      const canopen::ObjectId id{static_cast<std::uint16_t>(base + n), 1};
      if (dictionary.has(id)) dictionary.forget(id);
    }
  }
}

}  // namespace

bool restricted_id(std::uint32_t id) noexcept {
  for (const Range& range : kRestricted) {
    if (id >= range.first && id <= range.last) return true;
  }
  return false;
}

std::uint32_t check_communication_write(const ObjectDictionary& dictionary, canopen::ObjectId id,
                                        std::int64_t value) noexcept {
  switch (id.index) {
    case canopen::kErrorHistory:
      return value == 0 ? 0 : canopen::kAbortRange;
    case canopen::kStoreParameters:
      return value == kSaveWord ? 0 : canopen::kAbortStore;
    case canopen::kRestoreDefaults:
      return value == kLoadWord ? 0 : canopen::kAbortStore;
    case canopen::kEmergencyCobId:
      return check_emergency_id(dictionary, id, value);
    case canopen::kHeartbeatConsumer:
      return check_consumer(dictionary, id, value);
    default:
      return 0;
  }
}

void renumber(ObjectDictionary& dictionary, int from_node, int to_node) noexcept {
  const auto move = [&](int index, int sub) {
    const canopen::ObjectId id{static_cast<std::uint16_t>(index), static_cast<std::uint8_t>(sub)};
    const int position = dictionary.find(id);
    const bool of_node = position >= 0 && (dictionary.entry(position).initial & 0x7F) == from_node;
    if (of_node) dictionary.move_default(id, to_node - from_node);
  };
  move(canopen::kSdoServer, 1);
  move(canopen::kSdoServer, 2);
  move(canopen::kEmergencyCobId, 0);
  for (int n = 0; n < canopen::kPdoCount; ++n) {
    move(canopen::kRpdoCommunication + n, 1);
    move(canopen::kTpdoCommunication + n, 1);
  }
}

bool is_store_order(canopen::ObjectId id) noexcept {
  return id.index == canopen::kStoreParameters || id.index == canopen::kRestoreDefaults;
}

void obey_store_order(ObjectDictionary& dictionary, canopen::ObjectId id) noexcept {
  const Range range = range_of(id.sub);
  if (id.index == canopen::kStoreParameters) return dictionary.store(range.first, range.last);
  if (id.sub == kPdoIdsSub) return forget_pdo_ids(dictionary);
  dictionary.forget(range.first, range.last);
}

}  // namespace sprung::sim
