#pragma once
/// One message of an LCM log, and the bytes that stand before it in the file. Pure.
///
/// On disk, all numbers big endian: sync word (4 bytes), number (8), time (8), length of the channel's name
/// (4), length of the data (4), name, data. Nothing else is in the file: no header, no index, no checksum.
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace sprung::log {

inline constexpr std::uint32_t kSyncWord = 0xEDA1DA01;
inline constexpr std::size_t kSyncBytes = 4;
inline constexpr std::size_t kHeaderBytes = 28;
/// LCM's reader refuses names that are longer; names that came over its network have at most 63.
inline constexpr std::size_t kLongestChannel = 999;

/// `channel` and `data` point into the reader's buffer and stay as they are until its next call of next().
struct Event {
  std::int64_t number = 0;   ///< counts from 0 as it was written; starts again where logs were joined
  std::int64_t time_us = 0;  ///< when it was received, UTC; may go back by a little (facts L15)
  std::string_view channel;
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;
  std::uint64_t offset = 0;  ///< of its sync word in the file

  std::size_t bytes_in_file() const noexcept { return kHeaderBytes + channel.size() + size; }
};

}  // namespace sprung::log
