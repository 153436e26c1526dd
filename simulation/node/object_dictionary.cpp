#include "simulation/node/object_dictionary.h"

#include <algorithm>
#include <stdexcept>

#include "drivers/canopen/objects.h"
#include "drivers/canopen/sdo_buffer.h"

namespace sprung::sim {
namespace {

/// Writable, but an order and no parameter: clearing errors, saving, loading, moving the power stage.
constexpr std::uint16_t kCommands[] = {canopen::kErrorHistory, canopen::kStoreParameters,
                                       canopen::kRestoreDefaults, canopen::kControlWord};

std::size_t number_bytes(ObjectType type) noexcept {
  return static_cast<std::size_t>(canopen::type_bytes(type));
}

std::uint64_t get_number(const std::uint8_t* bytes, std::size_t count) noexcept {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < count; ++i) value |= static_cast<std::uint64_t>(bytes[i]) << (8 * i);
  return value;
}

void put_number(std::uint8_t* bytes, std::int64_t value, std::size_t count) noexcept {
  const auto raw = static_cast<std::uint64_t>(value);
  for (std::size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::uint8_t>((raw >> (8 * i)) & 0xFF);
}

}  // namespace

ObjectDictionary::ObjectDictionary(std::vector<ObjectEntry> entries, std::vector<std::uint16_t> dummies)
    : entries_(std::move(entries)), dummies_(std::move(dummies)) {
  build();
}

ObjectDictionary::ObjectDictionary(const canopen::Eds& eds, const std::vector<ObjectValue>& commissioning)
    : ObjectDictionary(entries_of(eds), eds.dummies) {
  for (const ObjectValue& known : commissioning) commission(known);
}

void ObjectDictionary::build() {
  std::sort(entries_.begin(), entries_.end(),
            [](const ObjectEntry& a, const ObjectEntry& b) { return key(a.id) < key(b.id); });
  std::size_t size = 1;
  while (size < 2 * entries_.size()) size *= 2;
  slots_.assign(size, Slot{});
  for (const ObjectEntry& entry : entries_) {
    Slot& place = slots_[slot(entry.id)];
    if (place.position >= 0)
      throw std::invalid_argument("object " + canopen::id_text(entry.id) + " is listed twice");
    place = {key(entry.id), static_cast<int>(values_.size())};
    values_.push_back(is_text(entry.type) ? static_cast<std::int64_t>(texts_.size()) : entry.initial);
    if (is_text(entry.type)) add_text(entry);
  }
  stored_ = values_;
}

void ObjectDictionary::add_text(const ObjectEntry& entry) {
  const std::size_t least = entry.type == ObjectType::kDomain ? canopen::kMaxTransfer : kTextBytes;
  Text text;
  for (auto* bytes : {&text.now, &text.stored}) {
    bytes->reserve(is_writable(entry.access) ? std::max(least, entry.text.size()) : entry.text.size());
    bytes->assign(entry.text.begin(), entry.text.end());
  }
  texts_.push_back(std::move(text));
}

void ObjectDictionary::commission(const ObjectValue& known) {
  const int position = find(known.id);
  if (position < 0 || is_text(entry(position).type))
    throw std::invalid_argument("there is no number " + canopen::id_text(known.id) + " to commission");
  if (!is_writable(entry(position).access)) entries_[position].initial = known.value;
  values_[position] = known.value;
  stored_[position] = known.value;
}

std::int64_t ObjectDictionary::get_or(canopen::ObjectId id, std::int64_t otherwise) const noexcept {
  const int position = find(id);
  return position < 0 ? otherwise : value(position);
}

std::uint32_t ObjectDictionary::missing(canopen::ObjectId id) const noexcept {
  const bool has_index = std::any_of(entries_.begin(), entries_.end(),
                                     [&](const ObjectEntry& entry) { return entry.id.index == id.index; });
  return has_index ? canopen::kAbortNoSub : canopen::kAbortNoObject;
}

std::uint32_t ObjectDictionary::read(canopen::ObjectId id, std::uint8_t* bytes, std::size_t capacity,
                                     std::size_t& size) const noexcept {
  const int position = find(id);
  if (position < 0) return missing(id);
  const ObjectEntry& object = entry(position);
  if (object.access == Access::kWriteOnly) return canopen::kAbortWriteOnly;
  if (!is_text(object.type)) {
    size = number_bytes(object.type);
    put_number(bytes, value(position), size);
    return 0;
  }
  const std::vector<std::uint8_t>& now = text(position).now;
  size = now.size();
  if (size == 0 && object.type != ObjectType::kVisibleString) return canopen::kAbortNoData;
  std::copy_n(now.begin(), std::min(size, capacity), bytes);
  return 0;
}

/// Texts may have any length that they have room for; CiA 301 has one code for a text that does not fit.
std::uint32_t ObjectDictionary::check_size(int position, std::size_t size, bool size_told) const noexcept {
  const ObjectType type = entry(position).type;
  if (is_text(type)) return size <= text(position).now.capacity() ? 0 : canopen::kAbortLength;
  if (size_told && size > number_bytes(type)) return canopen::kAbortTooLong;
  return size < number_bytes(type) ? canopen::kAbortTooShort : 0;
}

std::uint32_t ObjectDictionary::check(canopen::ObjectId id, const std::uint8_t* bytes, std::size_t size,
                                      bool size_told, std::int64_t& value) const noexcept {
  value = 0;
  const int position = find(id);
  if (position < 0) return missing(id);
  const ObjectEntry& object = entry(position);
  if (!is_writable(object.access)) return canopen::kAbortReadOnly;
  if (const std::uint32_t error = check_size(position, size, size_told)) return error;
  if (is_text(object.type)) return 0;
  value = from_wire(object.type, get_number(bytes, number_bytes(object.type)));
  return range_error(object, value);
}

void ObjectDictionary::accept(canopen::ObjectId id, const std::uint8_t* bytes, std::size_t size,
                              std::int64_t value) noexcept {
  const int position = find(id);
  if (!is_text(entry(position).type)) return set_value(position, value);
  text(position).now.assign(bytes, bytes + size);
}

void ObjectDictionary::write_process(int position, std::uint64_t raw) noexcept {
  const std::int64_t value = from_wire(entry(position).type, raw);
  if (range_error(entry(position), value) == 0) set_value(position, value);
}

bool ObjectDictionary::has_dummy(std::uint16_t index) const noexcept {
  return std::find(dummies_.begin(), dummies_.end(), index) != dummies_.end();
}

bool ObjectDictionary::storable(int position) const noexcept {
  const ObjectEntry& object = entry(position);
  return is_writable(object.access) &&
         std::find(std::begin(kCommands), std::end(kCommands), object.id.index) == std::end(kCommands);
}

template <typename Act>
void ObjectDictionary::each_storable(std::uint16_t first, std::uint16_t last, Act act) noexcept {
  for (int position = 0; position < size(); ++position) {
    const std::uint16_t index = entry(position).id.index;
    if (index >= first && index <= last && storable(position)) act(position);
  }
}

void ObjectDictionary::store(std::uint16_t first, std::uint16_t last) noexcept {
  each_storable(first, last, [this](int position) {
    if (is_text(entry(position).type))
      text(position).stored = text(position).now;
    else
      stored_[position] = value(position);
  });
}

void ObjectDictionary::forget_at(int position) noexcept {
  const ObjectEntry& object = entry(position);
  if (is_text(object.type))
    text(position).stored.assign(object.text.begin(), object.text.end());
  else
    stored_[position] = object.initial;
}

void ObjectDictionary::forget(std::uint16_t first, std::uint16_t last) noexcept {
  each_storable(first, last, [this](int position) { forget_at(position); });
}

void ObjectDictionary::forget(canopen::ObjectId id) noexcept { forget_at(find(id)); }

void ObjectDictionary::recall_at(int position) noexcept {
  if (is_text(entry(position).type))
    text(position).now = text(position).stored;
  else
    set_value(position, stored_[position]);
}

void ObjectDictionary::move_default(canopen::ObjectId id, std::int64_t by) noexcept {
  const int position = find(id);
  if (position < 0) return;
  const std::int64_t former = entries_[position].initial;
  entries_[position].initial += by;
  if (stored_[position] == former) stored_[position] += by;
  if (values_[position] == former) values_[position] += by;
}

void ObjectDictionary::recall(std::uint16_t first, std::uint16_t last) noexcept {
  each_storable(first, last, [this](int position) { recall_at(position); });
}

void ObjectDictionary::restart() noexcept {
  for (int position = 0; position < size(); ++position) recall_at(position);
}

ObjectHandle::ObjectHandle(ObjectDictionary& dictionary, canopen::ObjectId id)
    : dictionary_(&dictionary), position_(dictionary.find(id)) {
  if (position_ < 0) throw std::invalid_argument("there is no object " + canopen::id_text(id));
}

}  // namespace sprung::sim
