#include "drivers/canopen/eds_values.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <limits>

namespace sprung::canopen {
namespace {

struct TypeRow {
  EdsType type;
  int code;  ///< CiA 301 table 44
  int bytes;
  bool is_signed;
  const char* name;
};

constexpr TypeRow kTypes[] = {
    {EdsType::kBoolean, 0x01, 1, false, "boolean"},
    {EdsType::kI8, 0x02, 1, true, "i8"},
    {EdsType::kI16, 0x03, 2, true, "i16"},
    {EdsType::kI32, 0x04, 4, true, "i32"},
    {EdsType::kI64, 0x15, 8, true, "i64"},
    {EdsType::kU8, 0x05, 1, false, "u8"},
    {EdsType::kU16, 0x06, 2, false, "u16"},
    {EdsType::kU32, 0x07, 4, false, "u32"},
    {EdsType::kU64, 0x1B, 8, false, "u64"},
    {EdsType::kVisibleString, 0x09, 0, false, "visible string"},
    {EdsType::kOctetString, 0x0A, 0, false, "octet string"},
    {EdsType::kDomain, 0x0F, 0, false, "domain"},
};

const TypeRow& row(EdsType type) noexcept { return kTypes[static_cast<std::size_t>(type)]; }

std::int64_t highest(EdsType type) noexcept {
  if (type == EdsType::kBoolean) return 1;
  const int bits = std::min(63, 8 * row(type).bytes - (row(type).is_signed ? 1 : 0));
  return static_cast<std::int64_t>((std::uint64_t{1} << bits) - 1);
}

std::int64_t lowest(EdsType type) noexcept { return row(type).is_signed ? -highest(type) - 1 : 0; }

std::string without_blanks(std::string text) {
  text.erase(std::remove(text.begin(), text.end(), ' '), text.end());
  return lower_case(text);
}

/// Removes "$nodeid+" in front, "+$nodeid" behind. @return true when it was there.
bool take_node(std::string& text) {
  const std::string node = "$nodeid";
  const std::size_t place = text.find(node);
  if (text == node) {
    text = "0";
  } else if (place == 0 && text[node.size()] == '+') {
    text.erase(0, node.size() + 1);
  } else if (place != std::string::npos && place > 0 && text[place - 1] == '+' &&
             place + node.size() == text.size()) {
    text.erase(place - 1);
  } else {
    return false;
  }
  return true;
}

/// @return false when the text is not one whole number of at most 63 bits.
bool parse_whole(const std::string& text, std::int64_t& value) {
  char* end = nullptr;
  errno = 0;
  value = std::strtoll(text.c_str(), &end, 0);
  return !text.empty() && *end == '\0' && errno == 0;
}

std::string range_text(std::int64_t low, std::int64_t high) {
  return "write a whole number from " + std::to_string(low) + " to " + std::to_string(high);
}

/// A key's number in the range of its type; negative numbers may be written as hexadecimal two's complement.
std::optional<std::int64_t> read_number(const IniSection& section, const std::string& key, int node,
                                        EdsType type) {
  if (!section.has(key)) return std::nullopt;
  std::string text = without_blanks(section.text(key));
  const bool relative = take_node(text);
  std::int64_t value = 0;
  if (!parse_whole(text, value))
    section.fail(key, "not a number sprung can hold; " + range_text(lowest(type), highest(type)) +
                          ", or $NODEID+0x180");
  if (relative) value += node;
  const bool hexadecimal = text.rfind("0x", 0) == 0;
  if (row(type).is_signed && hexadecimal && value > highest(type) && value <= 2 * highest(type) + 1)
    value -= 2 * (highest(type) + 1);
  if (value < lowest(type) || value > highest(type))
    section.fail(key, std::string("does not fit into ") + type_name(type) + "; " +
                          range_text(lowest(type), highest(type)));
  return value;
}

void check_limits(const IniSection& section, const EdsObject& object) {
  const std::int64_t low = object.low_limit.value_or(lowest(object.type));
  const std::int64_t high = object.high_limit.value_or(highest(object.type));
  if (low > high) section.fail("LowLimit", "is above HighLimit=" + std::to_string(high) + "; swap them");
  if (object.default_value && (*object.default_value < low || *object.default_value > high))
    section.fail("DefaultValue", "is outside LowLimit and HighLimit; " + range_text(low, high));
}

void check_hexadecimal(const IniSection& section, const std::string& text) {
  if (text.size() % 2 != 0 || text.find_first_not_of("0123456789abcdef") != std::string::npos)
    section.fail("DefaultValue", "bytes are written as pairs of hexadecimal digits, e.g. 01 fe");
}

}  // namespace

int type_bytes(EdsType type) noexcept { return row(type).bytes; }
const char* type_name(EdsType type) noexcept { return row(type).name; }
bool is_signed(EdsType type) noexcept { return row(type).is_signed; }

std::int64_t read_integer(const IniSection& section, const std::string& key, std::int64_t otherwise,
                          std::int64_t low, std::int64_t high) {
  if (!section.has(key)) return otherwise;
  std::int64_t value = 0;
  if (!parse_whole(section.text(key), value) || value < low || value > high)
    section.fail(key, range_text(low, high));
  return value;
}

EdsType read_type(const IniSection& section) {
  if (!section.has("DataType")) section.fail("DataType", "is missing; e.g. DataType=0x0006 for a u16");
  const std::int64_t code = read_integer(section, "DataType", 0, 0, 0xFFFF);
  for (const TypeRow& known : kTypes) {
    if (known.code == code) return known.type;
  }
  section.fail("DataType",
               "is not supported; use 1 boolean, 2/3/4/0x15 i8/i16/i32/i64, 5/6/7/0x1B "
               "u8/u16/u32/u64, 9 visible string, 0xA octet string, 0xF domain");
}

void read_access(const IniSection& section, EdsObject& object) {
  const std::string word = lower_case(section.text("AccessType"));
  const bool mappable = read_integer(section, "PDOMapping", 0, 0, 1) == 1;
  if (word == "ro" || word == "const")
    object.access = word == "ro" ? EdsAccess::kReadOnly : EdsAccess::kConst;
  else if (word == "wo")
    object.access = EdsAccess::kWriteOnly;
  else if (word == "rw" || word == "rww" || word == "rwr")
    object.access = EdsAccess::kReadWrite;
  else
    section.fail("AccessType", "write ro, wo, rw, rww, rwr or const");
  object.map_receive = mappable && (word == "wo" || word == "rw" || word == "rww");
  object.map_transmit = mappable && word != "wo" && word != "rww";
}

void read_values(const IniSection& section, int node, EdsObject& object) {
  if (row(object.type).bytes > 0) {
    object.default_value = read_number(section, "DefaultValue", node, object.type);
    object.low_limit = read_number(section, "LowLimit", node, object.type);
    object.high_limit = read_number(section, "HighLimit", node, object.type);
    check_limits(section, object);
    return;
  }
  object.default_text = section.text("DefaultValue");
  if (object.type == EdsType::kVisibleString) return;
  object.default_text = without_blanks(object.default_text);
  check_hexadecimal(section, object.default_text);
}

}  // namespace sprung::canopen
