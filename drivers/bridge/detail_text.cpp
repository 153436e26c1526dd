#include "drivers/bridge/detail_text.h"

#include <cstdarg>
#include <cstdio>
#include <cstring>

#include "drivers/canopen/objects.h"

namespace sprung {
namespace {

/// Identities, identifiers and map entries are read in hexadecimal; quantities in decimal.
bool is_hexadecimal(std::uint16_t index) noexcept {
  return index == canopen::kIdentity || index == canopen::kHeartbeatConsumer ||
         (index >= canopen::kRpdoCommunication && index < 0x1C00);
}

void print_value(char* text, std::size_t size, const DriveSetting& setting, std::uint32_t value) noexcept {
  const std::uint32_t raw = low_bytes(value, setting.size);
  if (is_hexadecimal(setting.object.index)) {
    std::snprintf(text, size, "0x%X", raw);
  } else if (setting.is_signed) {
    const int shift = 32 - 8 * setting.size;
    std::snprintf(text, size, "%d", static_cast<std::int32_t>(raw << shift) >> shift);
  } else {
    std::snprintf(text, size, "%u", raw);
  }
}

}  // namespace

std::uint32_t low_bytes(std::uint32_t value, int size) noexcept {
  return size >= 4 ? value : value & ((1U << (8 * size)) - 1U);
}

std::string value_text(const DriveSetting& setting) {
  char text[16];
  print_value(text, sizeof text, setting, setting.value);
  return text;
}

void print(DetailText& text, const char* format, ...) noexcept {
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text.data(), text.size(), format, arguments);
  va_end(arguments);
}

void append(DetailText& text, const char* format, ...) noexcept {
  const std::size_t used = std::strlen(text.data());
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(text.data() + used, text.size() - used, format, arguments);
  va_end(arguments);
}

void print_difference(DetailText& text, const char* drive, const DriveSetting& setting,
                      std::uint32_t found) noexcept {
  char expected_text[16];
  char found_text[16];
  print_value(expected_text, sizeof expected_text, setting, setting.value);
  print_value(found_text, sizeof found_text, setting, found);
  print(text, "%s: object 0x%04X:%02X %s: expected %s, found %s", drive, setting.object.index,
        setting.object.sub, canopen::object_name(setting.object.index), expected_text, found_text);
}

void print_abort(DetailText& text, const char* drive, canopen::ObjectId object,
                 std::uint32_t abort_code) noexcept {
  print(text, "%s: object 0x%04X:%02X %s: refused by the drive (%s)", drive, object.index, object.sub,
        canopen::object_name(object.index), canopen::abort_text(abort_code));
}

}  // namespace sprung
