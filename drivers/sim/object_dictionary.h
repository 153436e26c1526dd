#pragma once
/// A CANopen device's objects: a table with types, access and limits, and SDO reading and writing by its
/// rules (facts canopen 1.4). Fixed after construction; reading and writing allocate nothing.
#include <cstdint>
#include <vector>

#include "drivers/canopen/protocol.h"

namespace sprung::sim {

enum class ObjectType : std::uint8_t { kU8, kU16, kU32, kU64, kI8, kI16, kI32 };
enum class Access : std::uint8_t { kReadOnly, kReadWrite, kWriteOnly };
/// Direction as the device sees it: kReceive may be in an RPDO.
enum class Mappable : std::uint8_t { kNo, kReceive, kTransmit };

struct ObjectEntry {
  canopen::ObjectId id;
  ObjectType type = ObjectType::kU32;
  Access access = Access::kReadOnly;
  Mappable mappable = Mappable::kNo;
  std::int64_t initial = 0;
  std::int64_t low = 0;  ///< low and high both 0: the type's own limits
  std::int64_t high = 0;
};

int type_bytes(ObjectType type) noexcept;
/// Value of a little-endian number of this type.
std::int64_t from_wire(ObjectType type, std::uint64_t raw) noexcept;

class ObjectDictionary {
 public:
  /// @throws std::invalid_argument when an object is listed twice.
  explicit ObjectDictionary(std::vector<ObjectEntry> entries);

  /// For the device itself: no access rules. The object must exist.
  std::int64_t get(canopen::ObjectId id) const noexcept;
  void set(canopen::ObjectId id, std::int64_t value) noexcept;

  /// SDO upload. @return 0 or an abort code.
  std::uint32_t read(canopen::ObjectId id, std::uint32_t& value, int& size) const noexcept;
  /// SDO download; size 0 = not told. @return 0 or an abort code.
  std::uint32_t write(canopen::ObjectId id, std::uint32_t raw, int size) noexcept;
  /// From a process data object: out of range is ignored, there being nobody to tell.
  void write_process(int position, std::uint64_t raw) noexcept;

  /// Position of an object for the calls below; -1 where there is none.
  int find(canopen::ObjectId id) const noexcept;
  const ObjectEntry& entry(int position) const noexcept {
    return entries_[static_cast<std::size_t>(position)];
  }
  std::int64_t value(int position) const noexcept { return values_[static_cast<std::size_t>(position)]; }

  /// Defaults again for indexes first..last.
  void restore(std::uint16_t first, std::uint16_t last) noexcept;

 private:
  std::uint32_t missing(canopen::ObjectId id) const noexcept;
  std::size_t slot(canopen::ObjectId id) const noexcept;

  std::vector<ObjectEntry> entries_;  ///< sorted by index and sub-index
  std::vector<int> slots_;  ///< hash table of positions, -1 = free; a power of two, at most half full
  std::vector<std::int64_t> values_;
};

}  // namespace sprung::sim
