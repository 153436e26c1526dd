#pragma once
/// One object of a simulated device: type, access, limits and default, as its EDS has them. The table is made
/// at start-up.
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "drivers/canopen/eds.h"

namespace sprung::sim {

using ObjectType = canopen::EdsType;
using Access = canopen::EdsAccess;

/// Direction as the device sees it: kReceive may be in an RPDO.
enum class Mappable : std::uint8_t { kNo, kReceive, kTransmit, kBoth };
constexpr bool receivable(Mappable mappable) noexcept {
  return mappable == Mappable::kReceive || mappable == Mappable::kBoth;
}
constexpr bool transmittable(Mappable mappable) noexcept {
  return mappable == Mappable::kTransmit || mappable == Mappable::kBoth;
}

inline constexpr std::int64_t kNoLow = std::numeric_limits<std::int64_t>::min();
inline constexpr std::int64_t kNoHigh = std::numeric_limits<std::int64_t>::max();

struct ObjectEntry {
  canopen::ObjectId id;
  ObjectType type = ObjectType::kU32;
  Access access = Access::kReadOnly;
  Mappable mappable = Mappable::kNo;
  std::int64_t initial = 0;   ///< the maker's default; a u64 bit for bit
  std::int64_t low = kNoLow;  ///< kNoLow, kNoHigh: the type's own limits
  std::int64_t high = kNoHigh;
  std::string text{};  ///< default bytes of a string or domain
};

/// What a device has from its commissioning, instead of the maker's default.
struct ObjectValue {
  canopen::ObjectId id;
  std::int64_t value = 0;
};

/// Every object of an EDS. A number without a default is 0, or the limit next to 0.
std::vector<ObjectEntry> entries_of(const canopen::Eds& eds);

/// Strings, octet strings and domains: any number of bytes.
constexpr bool is_text(ObjectType type) noexcept {
  return type == ObjectType::kVisibleString || type == ObjectType::kOctetString ||
         type == ObjectType::kDomain;
}
constexpr bool is_writable(Access access) noexcept {
  return access == Access::kReadWrite || access == Access::kWriteOnly;
}
/// Value of a little-endian number of this type.
std::int64_t from_wire(ObjectType type, std::uint64_t raw) noexcept;
/// 0, or why the value is refused.
std::uint32_t range_error(const ObjectEntry& entry, std::int64_t value) noexcept;

}  // namespace sprung::sim
