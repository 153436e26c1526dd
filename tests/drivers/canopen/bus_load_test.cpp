#include "drivers/canopen/bus_load.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "drivers/can/can_frame.h"

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

/// Bits of this very frame on the wire, with its CRC-15 and its stuff bits; remote frames too.
int exact_frame_bits(const CanFrame& frame) noexcept {
  const FrameBits bits(frame);
  return bits.size() + bits.stuff_bits() + kTailBits;
}

/// Fewest bits of a frame of `data_bytes` 0..8: 47 + 8 n, no stuff bit.
constexpr int bare_frame_bits(int data_bytes) noexcept { return 47 + 8 * data_bytes; }

CanFrame frame_of(std::uint32_t id, std::vector<std::uint8_t> bytes, bool remote = false) {
  CanFrame frame;
  frame.id = id;
  frame.length = static_cast<std::uint8_t>(bytes.size());
  frame.remote = remote;
  if (!remote) std::copy(bytes.begin(), bytes.end(), frame.data.begin());
  return frame;
}

struct Known {
  CanFrame frame;
  int crc;
  int bits;
};

// Worked out by a separate program that stuffs strings of 0 and 1; its CRC gives the published check value
// 0x059E for "123456789". SYNC = 51 is also in facts canopen 6.1.
const Known kKnown[] = {
    {frame_of(0x080, {}), 0x1C05, 51},
    {frame_of(0x000, {1, 0}), 0x6197, 68},
    {frame_of(0x701, {5}), 0x4D0E, 58},
    {frame_of(0x701, {0}, true), 31200, 51},
    {frame_of(0x181, {0, 0, 0, 0, 0, 0, 0, 0}), 0x4D06, 126},
    {frame_of(0x181, {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}), 0x2BCC, 124},
    {frame_of(0x201, {0x10, 0x27, 0x0F, 0}), 0x3A60, 84},
    {frame_of(0x7FF, {0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}), 0x4C89, 126},
    {frame_of(0x601, {0x23, 0, 0x18, 1, 0x81, 1, 0, 0xC0}), 0x44D6, 121},
    {frame_of(0x078, {0x3C, 0x3C, 0x3C, 0x3C, 0x3C, 0x3C, 0x3C, 0x3C}), 0x1921,
     131},  // a stuff bit begins a run
    {frame_of(0x555, {0x55, 0x55, 0x55, 0x55, 0x55, 0x55, 0x55, 0x55}), 0x1B04, 112},
};

TEST(BusLoad, FramesHaveTheBitsOfAnIndependentProgram) {
  for (const Known& known : kKnown) {
    EXPECT_EQ(FrameBits(known.frame).crc_word(), known.crc) << std::hex << known.frame.id;
    EXPECT_EQ(exact_frame_bits(known.frame), known.bits) << std::hex << known.frame.id;
  }
}

// Facts canopen 6.1, table of both rows.
TEST(BusLoad, WorstAndBareBitsAreThoseOfTheTable) {
  const int bare[] = {47, 55, 63, 71, 79, 87, 95, 103, 111};
  const int worst[] = {55, 65, 75, 85, 95, 105, 115, 125, 135};
  for (int n = 0; n <= 8; ++n) {
    EXPECT_EQ(bare_frame_bits(n), bare[n]);
    EXPECT_EQ(worst_frame_bits(n), worst[n]);
  }
}

TEST(BusLoad, EveryFrameLiesBetweenBareAndWorst) {
  std::mt19937 random(11);
  for (int i = 0; i < 20000; ++i) {
    CanFrame frame;
    frame.id = random() & 0x7FF;
    frame.length = static_cast<std::uint8_t>(random() % 9);
    // Few different bytes, so that long runs of equal bits are common.
    for (std::uint8_t& byte : frame.data)
      byte = random() % 2 == 0 ? std::uint8_t{0} : static_cast<std::uint8_t>(random());
    const int bits = exact_frame_bits(frame);
    ASSERT_GE(bits, bare_frame_bits(frame.length));
    ASSERT_LE(bits, worst_frame_bits(frame.length));
  }
}

// A remote frame asks for a length, and has no data on the wire.
TEST(BusLoad, RemoteFrameIsAsLongAsAnEmptyOne) {
  CanFrame guard = frame_of(0x701, {0, 0, 0, 0, 0, 0, 0, 0}, true);
  EXPECT_LE(exact_frame_bits(guard), worst_frame_bits(0));
}

// Facts canopen 6.3: packing (b), 880 worst bits at 500 Hz and 1 Mbit/s are 44 %.
TEST(BusLoad, ScheduleOfPackingBFillsFortyFourPerCent) {
  const int cycle = worst_frame_bits(0) + 3 * (worst_frame_bits(8) + worst_frame_bits(4)) +
                    worst_frame_bits(8);
  EXPECT_EQ(cycle, 880);
  EXPECT_DOUBLE_EQ(load(cycle * 500.0, 1e6), 0.44);
}

}  // namespace
}  // namespace sprung::canopen
