#include "drivers/canopen/sdo_block.h"

#include <algorithm>

namespace sprung::canopen {
namespace {

constexpr std::uint16_t kPolynomial = 0x1021;
constexpr std::uint8_t kLastSegment = 0x80;
constexpr int kMostFruitless = 8;  // blocks in a row of which nothing arrived [design choice]

bool is_block_size(int size) noexcept { return size >= 1 && size <= kMaxBlock; }

}  // namespace

std::uint16_t block_crc(const std::uint8_t* bytes, std::size_t count) noexcept {
  std::uint16_t crc = 0;
  for (std::size_t i = 0; i < count; ++i) {
    crc = static_cast<std::uint16_t>(crc ^ (bytes[i] << 8));
    for (int bit = 0; bit < 8; ++bit) {
      const bool carry = (crc & 0x8000) != 0;
      crc = static_cast<std::uint16_t>((crc << 1) ^ (carry ? kPolynomial : 0));
    }
  }
  return crc;
}

std::uint32_t BlockSender::begin(std::size_t size, int block_size) noexcept {
  *this = {};
  size_ = size;
  block_size_ = block_size;
  return is_block_size(block_size) ? 0 : kAbortBlockSize;
}

int BlockSender::segments() const noexcept {
  return std::max(1, static_cast<int>((size_ + kSegmentBytes - 1) / kSegmentBytes));
}

int BlockSender::unused() const noexcept { return segments() * kSegmentBytes - static_cast<int>(size_); }

bool BlockSender::next(std::uint32_t id, const std::uint8_t* value, CanFrame& segment) noexcept {
  const int at = base_ + sent_;
  if (done_ || sent_ == block_size_ || at == segments()) return false;
  const bool last = at + 1 == segments();
  const int count = last ? kSegmentBytes - unused() : kSegmentBytes;
  segment = sdo_block_segment(id, ++sent_, value + static_cast<std::ptrdiff_t>(at) * kSegmentBytes, count,
                              last);
  return true;
}

std::uint32_t BlockSender::acknowledge(const SdoBlockFields& fields) noexcept {
  if (fields.acknowledged > sent_ || done_) return kAbortBlockSequence;
  if (!is_block_size(fields.size)) return kAbortBlockSize;
  fruitless_ = fields.acknowledged == 0 ? fruitless_ + 1 : 0;
  if (fruitless_ > kMostFruitless) return kAbortBlockSequence;
  base_ += fields.acknowledged;
  sent_ = 0;
  block_size_ = fields.size;
  done_ = base_ == segments();
  return 0;
}

void BlockReceiver::begin() noexcept { *this = {}; }

std::uint32_t BlockReceiver::take(const CanFrame& segment, SdoBuffer& value, bool& due) noexcept {
  const int sequence = segment.data[0] & ~kLastSegment;
  const bool last = (segment.data[0] & kLastSegment) != 0;
  heard_ = true;
  due = last || sequence == kMaxBlock;
  if (complete_ || sequence != in_order_ + 1) return 0;
  ++in_order_;
  complete_ = last;
  if (!last) return value.append(&segment.data[1], kSegmentBytes, false);
  std::copy_n(segment.data.begin() + 1, kSegmentBytes, last_.begin());
  return 0;
}

int BlockReceiver::acknowledge() noexcept {
  const int result = in_order_;
  in_order_ = 0;
  heard_ = false;
  return result;
}

std::uint32_t BlockReceiver::finish(const SdoBlockFields& end, bool with_crc, SdoBuffer& value) noexcept {
  const std::uint32_t error = value.append(last_.data(), kSegmentBytes - end.unused, true);
  if (error != 0) return error;
  return with_crc && block_crc(value.data(), value.size()) != end.crc ? kAbortBlockCrc : 0;
}

}  // namespace sprung::canopen
