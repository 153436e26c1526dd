#include "drivers/canopen/bus_load.h"

#include <array>

namespace sprung::canopen {
namespace {

constexpr int kCrcBits = 15;
constexpr std::uint16_t kPolynomial = 0x4599;
constexpr int kStuffAfter = 5;  ///< equal bits
/// CRC delimiter, acknowledge slot and delimiter, end of frame (7), intermission (3): never stuffed.
constexpr int kTailBits = 13;

/// The stuffed part of a frame, bit by bit: start, identifier, RTR, IDE, r0, DLC, data, CRC.
class FrameBits {
 public:
  explicit FrameBits(const CanFrame& frame) noexcept {
    push(0, 1);
    push(frame.id, 11);
    push(frame.remote ? 1 : 0, 1);
    push(0, 2);
    push(frame.length, 4);
    for (int i = 0; i < frame.length && !frame.remote; ++i) push(frame.data[i], 8);
    crc_ = crc();
    push(crc_, kCrcBits);
  }

  int size() const noexcept { return size_; }
  std::uint16_t crc_word() const noexcept { return crc_; }

  int stuff_bits() const noexcept {
    int stuffed = 0, run = 0;
    bool last = true;  // the idle bus
    for (int i = 0; i < size_; ++i) {
      const bool bit = bits_[i];
      run = bit == last ? run + 1 : 1;
      last = bit;
      if (run < kStuffAfter) continue;
      ++stuffed;
      last = !bit;  // the stuff bit begins the next run
      run = 1;
    }
    return stuffed;
  }

 private:
  void push(std::uint32_t value, int count) noexcept {
    for (int i = count - 1; i >= 0; --i) bits_[size_++] = ((value >> i) & 1) != 0;
  }

  std::uint16_t crc() const noexcept {
    unsigned crc = 0;
    for (int i = 0; i < size_; ++i) {
      const bool invert = bits_[i] != (((crc >> (kCrcBits - 1)) & 1) != 0);
      crc = (crc << 1) & 0x7FFF;
      if (invert) crc ^= kPolynomial;
    }
    return static_cast<std::uint16_t>(crc);
  }

  std::array<bool, 19 + 64 + kCrcBits> bits_{};
  int size_ = 0;
  std::uint16_t crc_ = 0;
};

}  // namespace

int exact_frame_bits(const CanFrame& frame) noexcept {
  const FrameBits bits(frame);
  return bits.size() + bits.stuff_bits() + kTailBits;
}

std::uint16_t frame_crc(const CanFrame& frame) noexcept { return FrameBits(frame).crc_word(); }

}  // namespace sprung::canopen
