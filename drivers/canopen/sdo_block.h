#pragma once
/// The two ends of an SDO block transfer (CiA 301 7.2.4.3.9 and following), the same for client and server:
/// who sends a value in blocks of up to 127 segments, and who puts it together. A segment that is lost costs
/// what came after it in its block: the receiver acknowledges the last one that came in order, and the sender
/// goes on behind it. Pure; the bytes are an SdoBuffer's.
#include <array>
#include <cstddef>
#include <cstdint>

#include "drivers/canopen/sdo_buffer.h"
#include "drivers/canopen/sdo_frames.h"

namespace sprung::canopen {

/// Values up to this size take as many frames by segments as by a block.
inline constexpr std::size_t kBlockWorthwhile = 28;

/// CRC-16 of a block transfer: x^16 + x^12 + x^5 + 1, from 0, most significant bit first.
/// "123456789" has 0x31C3.
std::uint16_t block_crc(const std::uint8_t* bytes, std::size_t count) noexcept;

class BlockSender {
 public:
  /// @param size of the value, 0 and more. @param block_size segments that the receiver takes at once.
  /// @return 0, or kAbortBlockSize.
  std::uint32_t begin(std::size_t size, int block_size) noexcept;
  /// The next segment of the present block. @return false when its acknowledgement is awaited.
  bool next(std::uint32_t id, const std::uint8_t* value, CanFrame& segment) noexcept;
  /// @return 0; kAbortBlockSequence for one of segments that were never sent, and when the same ones are lost
  /// again and again; kAbortBlockSize.
  std::uint32_t acknowledge(const SdoBlockFields& fields) noexcept;
  bool done() const noexcept { return done_; }  ///< all is acknowledged: the end is due
  int unused() const noexcept;                  ///< bytes of the last segment that are no data

 private:
  int segments() const noexcept;  ///< that the value has; an empty one has one

  std::size_t size_ = 0;
  int block_size_ = 0;
  int base_ = 0;  ///< segments acknowledged before this block
  int sent_ = 0;  ///< of this block
  int fruitless_ = 0;
  bool done_ = false;
};

class BlockReceiver {
 public:
  void begin() noexcept;
  /// A segment. The value grows by what is in order; the last segment waits for finish(), since only the end
  /// says how many of its bytes are data.
  /// @param due set when the block is over: acknowledged() is to be sent. @return 0 or an abort code.
  std::uint32_t take(const CanFrame& segment, SdoBuffer& value, bool& due) noexcept;
  /// Of the block that is over, or broken off by silence; the next segment begins a new one.
  int acknowledge() noexcept;
  int in_order() const noexcept { return in_order_; }   ///< segments of this block
  bool begun() const noexcept { return heard_; }        ///< segments came since the last acknowledgement
  bool complete() const noexcept { return complete_; }  ///< the last segment is in: the end is awaited
  /// @param with_crc both sides can. @return 0, kAbortBlockCrc, or what SdoBuffer::append() says.
  std::uint32_t finish(const SdoBlockFields& end, bool with_crc, SdoBuffer& value) noexcept;

 private:
  int in_order_ = 0;  ///< segments of this block
  bool heard_ = false;
  bool complete_ = false;
  std::array<std::uint8_t, kSegmentBytes> last_{};
};

}  // namespace sprung::canopen
