#include "drivers/sim/object_dictionary.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace sprung::sim {
namespace {

constexpr std::uint32_t key(canopen::ObjectId id) noexcept {
  return (static_cast<std::uint32_t>(id.index) << 8) | id.sub;
}

bool before(const ObjectEntry& a, const ObjectEntry& b) noexcept { return key(a.id) < key(b.id); }

bool is_signed(ObjectType type) noexcept {
  return type == ObjectType::kI8 || type == ObjectType::kI16 || type == ObjectType::kI32;
}

std::uint32_t range_error(const ObjectEntry& entry, std::int64_t value) noexcept {
  if (entry.low == 0 && entry.high == 0) return 0;
  if (value < entry.low) return canopen::kAbortTooLow;
  return value > entry.high ? canopen::kAbortTooHigh : 0;
}

}  // namespace

int type_bytes(ObjectType type) noexcept {
  switch (type) {
    case ObjectType::kU8:
    case ObjectType::kI8:
      return 1;
    case ObjectType::kU16:
    case ObjectType::kI16:
      return 2;
    case ObjectType::kU64:
      return 8;
    case ObjectType::kU32:
    case ObjectType::kI32:
      break;
  }
  return 4;
}

std::int64_t from_wire(ObjectType type, std::uint64_t raw) noexcept {
  const int bits = 8 * type_bytes(type);
  if (bits == 64) return static_cast<std::int64_t>(raw);
  const std::uint64_t span = 1ULL << bits;
  const auto value = static_cast<std::int64_t>(raw & (span - 1));
  const bool negative = is_signed(type) && value >= static_cast<std::int64_t>(span / 2);
  return negative ? value - static_cast<std::int64_t>(span) : value;
}

ObjectDictionary::ObjectDictionary(std::vector<ObjectEntry> entries) : entries_(std::move(entries)) {
  std::sort(entries_.begin(), entries_.end(), before);
  for (std::size_t i = 1; i < entries_.size(); ++i) {
    if (!before(entries_[i - 1], entries_[i])) {
      throw std::invalid_argument("object " + std::to_string(entries_[i].id.index) + " is listed twice");
    }
  }
  std::size_t size = 1;
  while (size < 2 * entries_.size()) size *= 2;
  slots_.assign(size, -1);
  for (const ObjectEntry& entry : entries_) {
    slots_[slot(entry.id)] = static_cast<int>(values_.size());
    values_.push_back(entry.initial);
  }
}

/// Where the object is, or the free slot where it would be. The drives' loops ask 4000 times a second for some twenty.
std::size_t ObjectDictionary::slot(canopen::ObjectId id) const noexcept {
  constexpr std::uint32_t kGolden = 0x9E3779B1;  // Knuth's multiplicative hash
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = (key(id) * kGolden >> 16) & mask;
  while (slots_[at] >= 0 && !(entry(slots_[at]).id == id)) at = (at + 1) & mask;
  return at;
}

int ObjectDictionary::find(canopen::ObjectId id) const noexcept { return slots_[slot(id)]; }

std::int64_t ObjectDictionary::get(canopen::ObjectId id) const noexcept { return value(find(id)); }

void ObjectDictionary::set(canopen::ObjectId id, std::int64_t value) noexcept {
  values_[static_cast<std::size_t>(find(id))] = value;
}

std::uint32_t ObjectDictionary::missing(canopen::ObjectId id) const noexcept {
  const bool has_index = std::any_of(entries_.begin(), entries_.end(),
                                     [&](const ObjectEntry& entry) { return entry.id.index == id.index; });
  return has_index ? canopen::kAbortNoSub : canopen::kAbortNoObject;
}

std::uint32_t ObjectDictionary::read(canopen::ObjectId id, std::uint32_t& value, int& size) const noexcept {
  const int position = find(id);
  if (position < 0) return missing(id);
  if (entry(position).access == Access::kWriteOnly) return canopen::kAbortWriteOnly;
  size = type_bytes(entry(position).type);
  if (size > 4) return canopen::kAbortAccess;  // needs a segmented transfer
  value = static_cast<std::uint32_t>(this->value(position));
  return 0;
}

std::uint32_t ObjectDictionary::write(canopen::ObjectId id, std::uint32_t raw, int size) noexcept {
  const int position = find(id);
  if (position < 0) return missing(id);
  const ObjectEntry& entry = this->entry(position);
  if (entry.access == Access::kReadOnly) return canopen::kAbortReadOnly;
  const int bytes = type_bytes(entry.type);
  if (bytes > 4) return canopen::kAbortAccess;
  if (size > bytes) return canopen::kAbortTooLong;
  if (size != 0 && size < bytes) return canopen::kAbortTooShort;
  const std::int64_t value = from_wire(entry.type, raw);
  if (const std::uint32_t error = range_error(entry, value)) return error;
  values_[static_cast<std::size_t>(position)] = value;
  return 0;
}

void ObjectDictionary::write_process(int position, std::uint64_t raw) noexcept {
  const std::int64_t value = from_wire(entry(position).type, raw);
  if (range_error(entry(position), value) == 0) values_[static_cast<std::size_t>(position)] = value;
}

void ObjectDictionary::restore(std::uint16_t first, std::uint16_t last) noexcept {
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (entries_[i].id.index >= first && entries_[i].id.index <= last) values_[i] = entries_[i].initial;
  }
}

}  // namespace sprung::sim
