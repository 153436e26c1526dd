#pragma once
/// A CANopen device's objects and their values: SDO reading and writing by the rules of types, access and
/// limits (facts canopen 1.4), and the copy that outlives power (0x1010, 0x1011). The table is fixed after
/// construction; nothing else allocates.
#include <cstddef>
#include <cstdint>
#include <vector>

#include "drivers/canopen/sdo_aborts.h"
#include "simulation/node/object_entry.h"

namespace sprung::sim {

/// Each object has a present value, a stored one (what a reset brings back) and the maker's default.
class ObjectDictionary {
 public:
  /// Room that a writable string or octet string has at least [design choice].
  static constexpr std::size_t kTextBytes = 64;

  /// @param dummies objects 0x0001..0x0007 that may fill gaps in an RPDO.
  /// @throws std::invalid_argument when an object is listed twice.
  explicit ObjectDictionary(std::vector<ObjectEntry> entries, std::vector<std::uint16_t> dummies = {});
  /// @param commissioning stored values of writable objects; of others the default itself.
  /// @throws std::invalid_argument when the EDS does not have such a number.
  explicit ObjectDictionary(const canopen::Eds& eds, const std::vector<ObjectValue>& commissioning = {});

  // For the device itself: no access rules. The object must exist and be a number.
  std::int64_t get(canopen::ObjectId id) const noexcept { return value(find(id)); }
  void set(canopen::ObjectId id, std::int64_t value) noexcept { set_value(find(id), value); }
  /// For objects that not every device has.
  std::int64_t get_or(canopen::ObjectId id, std::int64_t otherwise) const noexcept;

  // By position, for what is asked every tick; -1 where there is no such object.
  int find(canopen::ObjectId id) const noexcept { return slots_[slot(id)].position; }
  bool has(canopen::ObjectId id) const noexcept { return find(id) >= 0; }
  const ObjectEntry& entry(int position) const noexcept { return entries_[position]; }
  std::int64_t value(int position) const noexcept { return values_[position]; }
  void set_value(int position, std::int64_t value) noexcept { values_[position] = value; }
  int size() const noexcept { return static_cast<int>(entries_.size()); }

  /// SDO upload. @param size set to the value's bytes. @return 0 or an abort code.
  std::uint32_t read(canopen::ObjectId id, std::uint8_t* bytes, std::size_t capacity,
                     std::size_t& size) const noexcept;
  /// Whether an SDO download would be taken. @param size_told false: the object takes what it needs.
  /// @param value set for numbers. @return 0 or an abort code.
  std::uint32_t check(canopen::ObjectId id, const std::uint8_t* bytes, std::size_t size, bool size_told,
                      std::int64_t& value) const noexcept;
  /// SDO download of what check() has passed.
  void accept(canopen::ObjectId id, const std::uint8_t* bytes, std::size_t size, std::int64_t value) noexcept;
  /// From a process data object: out of range is ignored, there being nobody to tell.
  void write_process(int position, std::uint64_t raw) noexcept;

  bool has_dummy(std::uint16_t index) const noexcept;

  /// Whether 0x1010 saves it: writable, and neither a command nor the error history.
  bool storable(int position) const noexcept;
  /// Present values of storable objects become the stored ones; of indexes first..last.
  void store(std::uint16_t first, std::uint16_t last) noexcept;
  /// Stored values become the maker's again.
  void forget(std::uint16_t first, std::uint16_t last) noexcept;
  void forget(canopen::ObjectId id) noexcept;
  /// The maker's default is another one now, and so is what had it; what differs from it stays. For objects
  /// that hang on the node id. Nothing where there is no such object.
  void move_default(canopen::ObjectId id, std::int64_t by) noexcept;
  /// Stored values become the present ones.
  void recall(std::uint16_t first, std::uint16_t last) noexcept;
  /// All stored values become the present ones: power on.
  void restart() noexcept;

 private:
  struct Slot {
    std::uint32_t key = 0;
    int position = -1;  ///< -1 = free
  };
  struct Text {
    std::vector<std::uint8_t> now, stored;  ///< with the same capacity, never exceeded
  };
  void build();
  void add_text(const ObjectEntry& entry);
  void commission(const ObjectValue& known);
  std::uint32_t missing(canopen::ObjectId id) const noexcept;
  static constexpr std::uint32_t key(canopen::ObjectId id) noexcept {
    return (static_cast<std::uint32_t>(id.index) << 8) | id.sub;
  }
  /// Where the object is, or the free slot where it would be. The drives' loops ask 4000 times a second for
  /// some twenty, so the key is in the table itself.
  std::size_t slot(canopen::ObjectId id) const noexcept {
    constexpr std::uint32_t kGolden = 0x9E3779B1;  // Knuth's multiplicative hash
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = (key(id) * kGolden >> 16) & mask;
    while (slots_[at].position >= 0 && slots_[at].key != key(id)) at = (at + 1) & mask;
    return at;
  }
  Text& text(int position) noexcept { return texts_[value(position)]; }
  const Text& text(int position) const noexcept { return texts_[value(position)]; }
  std::uint32_t check_size(int position, std::size_t size, bool size_told) const noexcept;
  template <typename Act>
  void each_storable(std::uint16_t first, std::uint16_t last, Act act) noexcept;
  void forget_at(int position) noexcept;
  void recall_at(int position) noexcept;

  std::vector<ObjectEntry> entries_;  ///< sorted by index and sub-index
  std::vector<std::uint16_t> dummies_;
  std::vector<Slot> slots_;           ///< hash table; a power of two, at most half full
  std::vector<std::int64_t> values_;  ///< of a text: where it is in texts_
  std::vector<std::int64_t> stored_;
  std::vector<Text> texts_;
};

/// One number of a dictionary, found once: for loops that run every tick. The dictionary must outlive it.
class ObjectHandle {
 public:
  /// @throws std::invalid_argument when there is no such object.
  ObjectHandle(ObjectDictionary& dictionary, canopen::ObjectId id);
  std::int64_t get() const noexcept { return dictionary_->value(position_); }
  void set(std::int64_t value) noexcept { dictionary_->set_value(position_, value); }

 private:
  ObjectDictionary* dictionary_;
  int position_;
};

}  // namespace sprung::sim
