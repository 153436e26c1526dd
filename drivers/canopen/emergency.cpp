#include "drivers/canopen/emergency.h"

#include <algorithm>
#include <cstring>

namespace sprung::canopen {
namespace {

constexpr const char* kRegisterNames[8] = {"generic",       "current",        "voltage",  "temperature",
                                           "communication", "device profile", "reserved", "manufacturer"};

/// Appends what fits, leaving the last 0.
void append(ErrorRegisterText& text, const char* more) noexcept {
  const std::size_t used = std::strlen(text.data());
  const std::size_t count = std::min(std::strlen(more), text.size() - 1 - used);
  std::copy(more, more + count, text.begin() + static_cast<std::ptrdiff_t>(used));
}

}  // namespace

CanFrame emergency_frame(int node, const Emergency& emergency) noexcept {
  CanFrame frame;
  frame.id = emcy_id(node);
  frame.length = 8;
  put_le(&frame.data[0], emergency.code, 2);
  frame.data[2] = emergency.error_register;
  std::copy(emergency.maker.begin(), emergency.maker.end(), frame.data.begin() + 3);
  return frame;
}

bool decode_emergency(const CanFrame& frame, Emergency& emergency) noexcept {
  if (frame.length != 8 || frame.remote || frame.error) return false;
  emergency.code = static_cast<std::uint16_t>(get_le(&frame.data[0], 2));
  emergency.error_register = frame.data[2];
  std::copy(frame.data.begin() + 3, frame.data.end(), emergency.maker.begin());
  return true;
}

ErrorRegisterText error_register_text(std::uint8_t error_register) noexcept {
  ErrorRegisterText text{};
  if (error_register == 0) append(text, "none");
  for (int bit = 0; bit < 8; ++bit) {
    if (((error_register >> bit) & 1) == 0) continue;
    if (text[0] != 0) append(text, ", ");
    append(text, kRegisterNames[bit]);
  }
  return text;
}

}  // namespace sprung::canopen
