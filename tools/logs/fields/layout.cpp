#include "tools/logs/fields/layout.h"

#include <endian.h>

#include <cstring>

namespace sprung::fields {

namespace {

template <class Unsigned>
Unsigned raw(const std::uint8_t* at) noexcept {
  Unsigned value = 0;
  std::memcpy(&value, at, sizeof value);
  return value;
}

}  // namespace

int Layout::find(std::string_view path) const noexcept {
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (fields[i].path == path) return static_cast<int>(i);
  }
  return kNone;
}

std::int64_t read_integer(Wire wire, const std::uint8_t* at) noexcept {
  switch (wire) {
    case Wire::kInt8:
      return static_cast<std::int8_t>(*at);
    case Wire::kByte:
    case Wire::kBoolean:
      return *at;
    case Wire::kInt16:
      return static_cast<std::int16_t>(be16toh(raw<std::uint16_t>(at)));
    case Wire::kInt32:
      return static_cast<std::int32_t>(be32toh(raw<std::uint32_t>(at)));
    case Wire::kFloat:
      return be32toh(raw<std::uint32_t>(at));
    case Wire::kInt64:
    case Wire::kDouble:
      return static_cast<std::int64_t>(be64toh(raw<std::uint64_t>(at)));
    case Wire::kString:
    case Wire::kStruct:
      return 0;
  }
  return 0;
}

}  // namespace sprung::fields
