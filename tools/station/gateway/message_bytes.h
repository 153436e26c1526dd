#pragma once
/// LCM messages as texts of the operator's link: channel's name, a zero byte, the encoded message.
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace sprung::gateway {

template <class M>
std::string encoded(const M& message) {
  std::string out(static_cast<std::size_t>(message.getEncodedSize()), '\0');
  message.encode(out.data(), 0, static_cast<int>(out.size()));
  return out;
}

inline std::string message_text(const std::string& channel, std::string_view bytes) {
  return (channel + '\0').append(bytes);
}

struct ChannelMessage {
  std::string channel;
  std::string_view bytes;  ///< of the text
};

inline std::optional<ChannelMessage> message_in(std::string_view text) {
  const std::size_t end = text.find('\0');
  if (end == std::string_view::npos) return std::nullopt;
  return ChannelMessage{std::string(text.substr(0, end)), text.substr(end + 1)};
}

}  // namespace sprung::gateway
