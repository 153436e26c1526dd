#include "tools/logs/log/checksum.h"

#include <zlib.h>

namespace sprung::log {

std::uint32_t checksum(std::string_view bytes, std::uint32_t before) noexcept {
  if (bytes.empty()) return before;  // zlib takes a null pointer for "begin anew"
  return static_cast<std::uint32_t>(
      crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace sprung::log
