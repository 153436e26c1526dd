#include "drivers/canopen/sdo_buffer.h"

#include <algorithm>

#include "drivers/canopen/sdo_frames.h"

namespace sprung::canopen {

bool SdoBuffer::assign(const std::uint8_t* bytes, std::size_t count) noexcept {
  filled(0);
  if (count > kMaxTransfer) return false;
  std::copy(bytes, bytes + count, bytes_.begin());
  size_ = count;
  return true;
}

void SdoBuffer::filled(std::size_t size) noexcept {
  size_ = size;
  at_ = 0;
}

SdoBuffer::Chunk SdoBuffer::next() noexcept {
  const std::size_t count = std::min<std::size_t>(size_ - at_, kSegmentBytes);
  const Chunk chunk{bytes_.data() + at_, static_cast<int>(count), at_ + count == size_};
  at_ += count;
  return chunk;
}

std::uint32_t SdoBuffer::expect(bool told, std::uint32_t size) noexcept {
  filled(0);
  told_ = told;
  announced_ = size;
  return told && size > kMaxTransfer ? kAbortMemory : 0;
}

std::uint32_t SdoBuffer::append(const std::uint8_t* bytes, int count, bool last) noexcept {
  const std::size_t total = size_ + static_cast<std::size_t>(count);
  if (told_ && total > announced_) return kAbortTooLong;
  if (told_ && last && total < announced_) return kAbortTooShort;
  if (total > kMaxTransfer) return kAbortMemory;
  std::copy(bytes, bytes + count, bytes_.begin() + static_cast<std::ptrdiff_t>(size_));
  size_ = total;
  return 0;
}

}  // namespace sprung::canopen
