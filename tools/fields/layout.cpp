#include "tools/fields/layout.h"

namespace sprung::fields {

const char* name(Fault fault) noexcept {
  switch (fault) {
    case Fault::kNone:
      return "none";
    case Fault::kTooShort:
      return "too short";
    case Fault::kUnknownType:
      return "unknown type";
    case Fault::kBadCount:
      return "impossible count";
    case Fault::kBadText:
      return "broken text";
    case Fault::kTrailing:
      return "trailing bytes";
  }
  return "unknown";
}

int Layout::find(std::string_view path) const noexcept {
  for (std::size_t i = 0; i < fields.size(); ++i) {
    if (fields[i].path == path) return static_cast<int>(i);
  }
  return kNone;
}

std::int64_t read_integer(Wire wire, const std::uint8_t* at) noexcept {
  std::uint64_t value = 0;
  const std::size_t size = size_of(wire);
  for (std::size_t i = 0; i < size; ++i) value = (value << 8U) | at[i];
  switch (wire) {
    case Wire::kInt8:
      return static_cast<std::int8_t>(value);
    case Wire::kInt16:
      return static_cast<std::int16_t>(value);
    case Wire::kInt32:
      return static_cast<std::int32_t>(value);
    default:
      return static_cast<std::int64_t>(value);
  }
}

}  // namespace sprung::fields
