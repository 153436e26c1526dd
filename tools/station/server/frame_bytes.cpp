#include "tools/station/server/frame_bytes.h"

#include <cstdint>
#include <cstring>

namespace sprung::station {
namespace {

template <class Bits, class Number>
char* put(Number number, char* to) {
  static_assert(sizeof(Bits) == sizeof(Number));
  Bits bits;
  std::memcpy(&bits, &number, sizeof bits);
  for (std::size_t i = 0; i < sizeof bits; ++i) *to++ = static_cast<char>(bits >> (8 * i) & 0xFFU);
  return to;
}

}  // namespace

std::string frame_bytes(const Frame& frame) {
  std::string out(sizeof(double) + frame.values.size() * sizeof(float), '\0');
  char* to = put<std::uint64_t>(frame.time_s, out.data());
  for (const float value : frame.values) to = put<std::uint32_t>(value, to);
  return out;
}

}  // namespace sprung::station
