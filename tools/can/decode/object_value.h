#pragma once
/// Bytes of an object, as they travel in SDOs and PDOs, in the words of its EDS: type, unit, and meaning
/// where the value is a code. And back, for writing. Pure.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/canopen/eds.h"

namespace sprung::cantools {

struct ObjectValue {
  std::optional<std::int64_t> number;  ///< none for texts and domains; see is_wide
  std::string text;                    ///< "123", "0x0237 operation enabled", "\"EPOS2\""
  std::string unit;                    ///< "" where there is none
  bool is_wide = false;                ///< unsigned, of 64 bits: `number` holds the same bits
};

/// 0 where there is no number.
double as_double(const ObjectValue& value) noexcept;

/// @param described nullptr where no EDS has the object: then up to 8 bytes are an unsigned number, more are
/// shown as they are.
ObjectValue object_value(const canopen::EdsObject* described, canopen::ObjectId id, const std::uint8_t* bytes,
                         std::size_t count);

/// "123 counts", "operation enabled".
std::string with_unit(const ObjectValue& value);

/// Little-endian number of 0..8 bytes.
std::int64_t number_of(const std::uint8_t* bytes, std::size_t count, bool is_signed) noexcept;

/// Bytes for the wire. @param text decimal or 0x number in the object's own unit; text for strings;
/// hexadecimal digits for octet strings and domains.
/// @throws std::invalid_argument naming object, value and what is allowed: type, EDS limits, access.
std::vector<std::uint8_t> bytes_to_write(const canopen::EdsObject& object, const std::string& text);

}  // namespace sprung::cantools
