#pragma once
/// The first and the last message of a log file: LOG_METADATA and LOG_END. Their bytes come from a file that
/// anyone may have made, so they are checked before LCM's decoder sees them.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "runtime/message_layout.h"
#include "signals/modes.h"
#include "sprung_msgs/log_end_t.hpp"
#include "sprung_msgs/log_metadata_t.hpp"

namespace sprung {

template <>
MessageLayout layout_of<sprung_msgs::log_metadata_t>();
template <>
MessageLayout layout_of<sprung_msgs::log_end_t>();

/// @return nothing where the bytes are not such a message.
std::optional<sprung_msgs::log_metadata_t> read_log_metadata(const std::uint8_t* data, std::size_t size);
std::optional<sprung_msgs::log_end_t> read_log_end(const std::uint8_t* data, std::size_t size);

/// The bytes that LCM would send.
template <class M>
std::vector<std::uint8_t> message_bytes(const M& message) {
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

}  // namespace sprung
