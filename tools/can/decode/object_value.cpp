#include "tools/can/decode/object_value.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <stdexcept>

#include "drivers/canopen/emergency.h"
#include "drivers/canopen/objects.h"
#include "drivers/canopen/pdo_words.h"
#include "drivers/cia402/words.h"
#include "tools/can/decode/word_texts.h"

namespace sprung::cantools {
namespace {

using canopen::EdsObject;
using canopen::EdsType;
using canopen::ObjectId;

std::string hex(std::uint64_t value, std::size_t bytes) {
  char text[24];
  std::snprintf(text, sizeof text, "0x%0*llX", static_cast<int>(2 * bytes),
                static_cast<unsigned long long>(value));
  return text;
}

std::string hex_dump(const std::uint8_t* bytes, std::size_t count) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    char pair[4];
    std::snprintf(pair, sizeof pair, "%02X", bytes[i]);
    text += (i == 0 ? "" : " ") + std::string(pair);
  }
  return text;
}

bool is_text(const std::uint8_t* bytes, std::size_t count) {
  return std::all_of(bytes, bytes + count, [](std::uint8_t c) { return c >= 0x20 && c < 0x7F; });
}

/// Identifiers, map entries and identities are read in hexadecimal.
bool is_hexadecimal(ObjectId id, const EdsObject* described) {
  const bool word = described == nullptr || described->type == EdsType::kU32;
  const bool communication = id.index >= 0x1000 && id.index < 0x2000 && id.index != canopen::kSyncPeriod;
  return word && communication && (described == nullptr || described->unit.empty());
}

ObjectValue text_value(const EdsObject* described, const std::uint8_t* bytes, std::size_t count) {
  const bool octets = described != nullptr && described->type != EdsType::kVisibleString;
  if (!octets && is_text(bytes, count)) {
    return {std::nullopt, "\"" + std::string(reinterpret_cast<const char*>(bytes), count) + "\"",
            described != nullptr ? described->unit : ""};
  }
  return {std::nullopt, hex_dump(bytes, count), ""};
}

std::int64_t parse_number(const EdsObject& object, const std::string& text) {
  const bool negative = !text.empty() && text[0] == '-';
  const std::string digits = text.substr(negative ? 1 : 0);
  const bool is_hex = digits.rfind("0x", 0) == 0 || digits.rfind("0X", 0) == 0;
  std::uint64_t value = 0;
  const char* begin = digits.c_str() + (is_hex ? 2 : 0);
  const char* end = digits.c_str() + digits.size();
  const auto [last, error] = std::from_chars(begin, end, value, is_hex ? 16 : 10);
  if (error != std::errc() || last != end ||
      value > static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max())) {
    throw std::invalid_argument(canopen::id_text(object.id) + " " + object.name + ": '" + text +
                                "' is no whole number (" + canopen::type_name(object.type) +
                                (object.unit.empty() ? "" : ", in " + object.unit) + ")");
  }
  return negative ? -static_cast<std::int64_t>(value) : static_cast<std::int64_t>(value);
}

/// Ends of the type, narrowed by the EDS's limits. A u64 is limited to what an int64 holds, as in the EDS
/// reader.
std::pair<std::int64_t, std::int64_t> range_of(const EdsObject& object) {
  const int bits = 8 * canopen::type_bytes(object.type);
  std::int64_t low = 0, high = std::numeric_limits<std::int64_t>::max();
  if (object.type == EdsType::kBoolean) {
    high = 1;
  } else if (canopen::is_signed(object.type)) {
    if (bits < 64) high = (std::int64_t{1} << (bits - 1)) - 1;
    low = -high - 1;
  } else if (bits < 64) {
    high = (std::int64_t{1} << bits) - 1;
  }
  return {std::max(low, object.low_limit.value_or(low)), std::min(high, object.high_limit.value_or(high))};
}

std::vector<std::uint8_t> number_bytes(const EdsObject& object, const std::string& text) {
  const std::int64_t value = parse_number(object, text);
  const auto [low, high] = range_of(object);
  if (value < low || value > high) {
    throw std::invalid_argument(canopen::id_text(object.id) + " " + object.name + ": " + text +
                                " is not between " + std::to_string(low) + " and " + std::to_string(high) +
                                (object.unit.empty() ? "" : " " + object.unit) + " (EDS)");
  }
  std::vector<std::uint8_t> bytes;
  bytes.reserve(canopen::type_bytes(object.type));
  for (int i = 0; i < canopen::type_bytes(object.type); ++i) {
    bytes.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * i)));
  }
  return bytes;
}

std::vector<std::uint8_t> octets(const EdsObject& object, const std::string& text) {
  std::vector<std::uint8_t> bytes;
  for (std::size_t at = 0; at < text.size(); at += 2) {
    std::uint8_t byte = 0;
    const char* end = text.data() + std::min(at + 2, text.size());
    const auto [last, error] = std::from_chars(text.data() + at, end, byte, 16);
    if (error != std::errc() || last != text.data() + at + 2) {
      throw std::invalid_argument(canopen::id_text(object.id) + " " + object.name + ": '" + text +
                                  "' is no string of hexadecimal bytes, e.g. 0A1B");
    }
    bytes.push_back(byte);
  }
  return bytes;
}

}  // namespace

std::int64_t number_of(const std::uint8_t* bytes, std::size_t count, bool is_signed) noexcept {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < count && i < 8; ++i) value |= static_cast<std::uint64_t>(bytes[i]) << (8 * i);
  const bool negative = is_signed && count > 0 && count < 8 && (bytes[count - 1] & 0x80) != 0;
  if (negative) value |= ~std::uint64_t{0} << (8 * count);
  return static_cast<std::int64_t>(value);
}

ObjectValue object_value(const EdsObject* described, ObjectId id, const std::uint8_t* bytes,
                         std::size_t count) {
  const bool numeric = described != nullptr ? canopen::type_bytes(described->type) > 0 : count <= 8;
  if (!numeric || count == 0 || count > 8) return text_value(described, bytes, count);
  const bool is_signed = described != nullptr && canopen::is_signed(described->type);
  const std::int64_t number = number_of(bytes, count, is_signed);
  ObjectValue value{number, "", described != nullptr ? described->unit : "", !is_signed && count == 8};
  value.text = value.is_wide ? std::to_string(static_cast<std::uint64_t>(number)) : std::to_string(number);
  const std::string meaning = word_meaning(id, number);
  if (is_code_word(id) || is_hexadecimal(id, described)) {
    value.text = hex(static_cast<std::uint64_t>(number), count);
    value.unit.clear();
  }
  if (!meaning.empty()) value.text += " (" + meaning + ")";
  return value;
}

double as_double(const ObjectValue& value) noexcept {
  const std::int64_t number = value.number.value_or(0);
  return value.is_wide ? static_cast<double>(static_cast<std::uint64_t>(number))
                       : static_cast<double>(number);
}

std::string with_unit(const ObjectValue& value) {
  return value.unit.empty() ? value.text : value.text + " " + value.unit;
}

std::vector<std::uint8_t> bytes_to_write(const EdsObject& object, const std::string& text) {
  if (object.access == canopen::EdsAccess::kReadOnly || object.access == canopen::EdsAccess::kConst) {
    throw std::invalid_argument(canopen::id_text(object.id) + " " + object.name +
                                " is read-only (EDS): nothing was sent");
  }
  if (canopen::type_bytes(object.type) > 0) return number_bytes(object, text);
  if (object.type == EdsType::kVisibleString) return {text.begin(), text.end()};
  return octets(object, text);
}

}  // namespace sprung::cantools
