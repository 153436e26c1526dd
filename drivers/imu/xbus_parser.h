#pragma once
/// Messages of Xsens' Xbus protocol out of a stream of bytes that may begin anywhere and be damaged (public
/// "MT Low Level Communication Protocol Documentation"): preamble FA, bus id FF, message id, length (or FF
/// and a length of two bytes), data, checksum: all bytes behind the preamble add up to 0, modulo 256. Pure;
/// fixed capacity.
#include <array>
#include <cstddef>
#include <cstdint>

namespace sprung::imu {

/// What a message carries; its bytes are good until the parser is given more.
struct XbusMessage {
  std::uint8_t id = 0;
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;
};

/// Since the beginning.
struct XbusCounters {
  std::int64_t messages = 0;
  std::int64_t skipped_bytes = 0;  ///< that belong to no good message
  std::int64_t bad_checksums = 0;
};

class XbusParser {
 public:
  /// Longest data that is believed: the length of a damaged message may say anything [design choice: an
  /// MTData2 of all outputs there are has some 250 bytes].
  static constexpr std::size_t kMostData = 1024;

  /// @return true when `byte` ends a good message, which is then in `message`.
  bool take(std::uint8_t byte, XbusMessage& message) noexcept;
  /// The line was closed: what is half there is none.
  void restart() noexcept;
  const XbusCounters& counters() const noexcept { return counters_; }

 private:
  static constexpr std::size_t kMostHeader = 6;  ///< preamble to a length of two bytes
  bool look(XbusMessage& message) noexcept;
  bool may_begin_here() const noexcept;
  std::size_t header_size() const noexcept;
  std::size_t data_size() const noexcept;
  void drop(std::size_t count) noexcept;

  std::array<std::uint8_t, kMostHeader + kMostData + 1> bytes_{};
  std::size_t count_ = 0;
  std::size_t done_ = 0;  ///< bytes of the message that was given last
  XbusCounters counters_;
};

}  // namespace sprung::imu
