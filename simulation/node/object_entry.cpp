#include "simulation/node/object_entry.h"

#include <algorithm>

#include "drivers/canopen/sdo_aborts.h"

namespace sprung::sim {
namespace {

Mappable mappable_of(const canopen::EdsObject& object) noexcept {
  if (object.map_receive) return object.map_transmit ? Mappable::kBoth : Mappable::kReceive;
  return object.map_transmit ? Mappable::kTransmit : Mappable::kNo;
}

/// "01fe" to its two bytes; the EDS reader has checked the digits.
std::string bytes_of(const std::string& hexadecimal) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hexadecimal.size(); i += 2)
    bytes.push_back(static_cast<char>(std::stoul(hexadecimal.substr(i, 2), nullptr, 16)));
  return bytes;
}

ObjectEntry entry_of(const canopen::EdsObject& object) {
  ObjectEntry entry;
  entry.id = object.id;
  entry.type = object.type;
  entry.access = object.access;
  entry.mappable = mappable_of(object);
  entry.low = object.low_limit.value_or(kNoLow);
  entry.high = object.high_limit.value_or(object.type == ObjectType::kBoolean ? 1 : kNoHigh);
  entry.initial = object.default_value.value_or(std::clamp<std::int64_t>(0, entry.low, entry.high));
  entry.text = object.type == ObjectType::kVisibleString ? object.default_text
                                                         : bytes_of(object.default_text);
  return entry;
}

}  // namespace

std::vector<ObjectEntry> entries_of(const canopen::Eds& eds) {
  std::vector<ObjectEntry> entries;
  for (const canopen::EdsObject& object : eds.objects) entries.push_back(entry_of(object));
  return entries;
}

std::int64_t from_wire(ObjectType type, std::uint64_t raw) noexcept {
  const int bits = 8 * canopen::type_bytes(type);
  if (bits == 64) return static_cast<std::int64_t>(raw);
  const std::uint64_t span = 1ULL << bits;
  const auto value = static_cast<std::int64_t>(raw & (span - 1));
  const bool negative = canopen::is_signed(type) && value >= static_cast<std::int64_t>(span / 2);
  return negative ? value - static_cast<std::int64_t>(span) : value;
}

std::uint32_t range_error(const ObjectEntry& entry, std::int64_t value) noexcept {
  if (value < entry.low) return canopen::kAbortTooLow;
  return value > entry.high ? canopen::kAbortTooHigh : 0;
}

}  // namespace sprung::sim
