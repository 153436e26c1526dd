#include "drivers/imu/xbus_parser.h"

#include <algorithm>
#include <numeric>

namespace sprung::imu {
namespace {

constexpr std::uint8_t kPreamble = 0xFA;
constexpr std::uint8_t kMaster = 0xFF;          // bus id of a sensor that stands alone
constexpr std::uint8_t kExtendedLength = 0xFF;  // two bytes follow

}  // namespace

void XbusParser::restart() noexcept { count_ = done_ = 0; }

std::size_t XbusParser::header_size() const noexcept { return bytes_[3] == kExtendedLength ? 6 : 4; }

std::size_t XbusParser::data_size() const noexcept {
  return bytes_[3] == kExtendedLength ? std::size_t{bytes_[4]} << 8 | bytes_[5] : bytes_[3];
}

void XbusParser::drop(std::size_t count) noexcept {
  std::copy(bytes_.begin() + static_cast<std::ptrdiff_t>(count),
            bytes_.begin() + static_cast<std::ptrdiff_t>(count_), bytes_.begin());
  count_ -= count;
}

/// As far as its bytes are there.
bool XbusParser::may_begin_here() const noexcept {
  if (count_ >= 1 && bytes_[0] != kPreamble) return false;
  if (count_ >= 2 && bytes_[1] != kMaster) return false;
  return count_ < 4 || count_ < header_size() || data_size() <= kMostData;
}

bool XbusParser::look(XbusMessage& message) noexcept {
  while (count_ > 0) {
    if (may_begin_here()) {
      if (count_ < 4 || count_ < header_size()) return false;
      const std::size_t header = header_size(), size = header + data_size() + 1;
      if (count_ < size) return false;
      const auto end = bytes_.begin() + static_cast<std::ptrdiff_t>(size);
      if ((std::accumulate(bytes_.begin() + 1, end, 0U) & 0xFF) == 0) {
        message = {bytes_[2], &bytes_[header], data_size()};
        done_ = size;
        ++counters_.messages;
        return true;
      }
      ++counters_.bad_checksums;
    }
    drop(1);  // a preamble may stand anywhere behind
    ++counters_.skipped_bytes;
  }
  return false;
}

bool XbusParser::take(std::uint8_t byte, XbusMessage& message) noexcept {
  drop(done_);
  done_ = 0;
  bytes_[count_++] = byte;
  return look(message);
}

}  // namespace sprung::imu
