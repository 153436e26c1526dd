#pragma once
/// Frames that were sent and whose own echo from the bus is awaited: pairs each echo with its sending. Pure.
#include <array>
#include <cstddef>
#include <cstdint>

#include "drivers/can/can_frame.h"

namespace sprung {

class SendConfirmations {
 public:
  static constexpr std::size_t kCapacity = 256;  ///< several cycles of a full bus
  static constexpr std::int64_t kUnknown = -1;

  /// @param time_us when it was handed over. The oldest frame is given up when there are too many.
  void sent(const CanFrame& frame, std::int64_t time_us) noexcept;
  /// Controllers may send by priority instead of in order. @return us from sending to confirmation; kUnknown
  /// when no such frame is awaited.
  std::int64_t confirmed(const CanFrame& frame, std::int64_t time_us) noexcept;
  /// The interface's queue was emptied (link down, bus off): nothing more will come.
  void forget() noexcept;
  std::size_t awaited() const noexcept { return awaited_; }
  std::int64_t unconfirmed() const noexcept { return unconfirmed_; }  ///< given up or forgotten

 private:
  struct Entry {
    CanFrame frame;
    std::int64_t time_us = 0;
    bool awaited = false;
  };
  Entry& at(std::size_t i) noexcept { return ring_[(first_ + i) % kCapacity]; }
  void drop_done() noexcept;

  std::array<Entry, kCapacity> ring_{};
  std::size_t first_ = 0;
  std::size_t size_ = 0;  ///< entries from first_, those already confirmed among them included
  std::size_t awaited_ = 0;
  std::int64_t unconfirmed_ = 0;
};

}  // namespace sprung
