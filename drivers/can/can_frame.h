#pragma once
/// One classic CAN frame with an 11-bit identifier.
#include <array>
#include <cstdint>

namespace sprung {

struct CanFrame {
  std::uint32_t id = 0;     ///< 0..0x7FF
  std::uint8_t length = 0;  ///< 0..8
  std::array<std::uint8_t, 8> data{};
  bool error = false;   ///< SocketCAN error frame, or the end-of-tick mark of the lock-step link
  bool remote = false;  ///< remote request (RTR): node guarding; carries no data
  bool operator==(const CanFrame& other) const noexcept {
    return id == other.id && length == other.length && data == other.data && error == other.error &&
           remote == other.remote;
  }
};

/// A frame on one of the robot's buses.
struct BusFrame {
  int bus = 0;
  CanFrame frame;
};

/// Frames of one step, in order. Fixed capacity, so that a step allocates nothing; overflow is counted, never
/// silent.
class FrameBatch {
 public:
  static constexpr int kCapacity = 512;
  void clear() noexcept { size_ = 0; }
  bool push(int bus, const CanFrame& frame) noexcept {
    if (size_ == kCapacity) {
      ++overflow_;
      return false;
    }
    frames_[size_++] = {bus, frame};
    return true;
  }
  int size() const noexcept { return size_; }
  int overflow() const noexcept { return overflow_; }
  const BusFrame& operator[](int i) const noexcept { return frames_[i]; }
  const BusFrame* begin() const noexcept { return frames_.data(); }
  const BusFrame* end() const noexcept { return frames_.data() + size_; }

 private:
  std::array<BusFrame, kCapacity> frames_{};
  int size_ = 0;
  int overflow_ = 0;
};

/// @param out at least kCapacity. @return how many of the batch are for `bus`, copied in order.
inline int frames_of_bus(const FrameBatch& batch, int bus, CanFrame* out) noexcept {
  int count = 0;
  for (const BusFrame& frame : batch) {
    if (frame.bus == bus) out[count++] = frame.frame;
  }
  return count;
}

}  // namespace sprung
