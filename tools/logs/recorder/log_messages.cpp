#include "tools/logs/recorder/log_messages.h"

#include "lcmtypes/channels.h"
#include "runtime/receive_guard.h"

namespace sprung {

namespace {

/// Encoded size of an empty string: its length and the terminating zero.
constexpr std::size_t kEmptyString = 5;

template <class M>
MessageLayout layout_with_strings(int strings) {
  MessageLayout layout;
  layout.hash = M::getHash();
  layout.strings = strings;
  layout.fixed_size = static_cast<std::size_t>(M().getEncodedSize()) -
                      static_cast<std::size_t>(strings) * kEmptyString;
  return layout;
}

template <class M>
std::optional<M> read(const char* channel, const std::uint8_t* data, std::size_t size) {
  ReceiveGuard guard(channel, layout_of<M>(), CountLimits::none(), 0);
  M message;
  if (guard.decode(data, size, message) != Refusal::kNone) return std::nullopt;
  return message;
}

}  // namespace

template <>
MessageLayout layout_of<sprung_msgs::log_metadata_t>() {
  return layout_with_strings<sprung_msgs::log_metadata_t>(9);
}

template <>
MessageLayout layout_of<sprung_msgs::log_end_t>() {
  return layout_with_strings<sprung_msgs::log_end_t>(1);
}

std::optional<sprung_msgs::log_metadata_t> read_log_metadata(const std::uint8_t* data, std::size_t size) {
  return read<sprung_msgs::log_metadata_t>(channels::kLogMetadata, data, size);
}

std::optional<sprung_msgs::log_end_t> read_log_end(const std::uint8_t* data, std::size_t size) {
  return read<sprung_msgs::log_end_t>(channels::kLogEnd, data, size);
}

}  // namespace sprung
