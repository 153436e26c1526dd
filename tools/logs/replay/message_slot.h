#pragma once
/// One kind of message on its way between bytes and signal; keeps its memory from one message to the next.
#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>

#include "runtime/message_layout.h"
#include "runtime/receive_guard.h"
#include "signals/messages.h"
#include "tools/logs/replay/log_cycles.h"

namespace sprung {

template <class Signal>
class MessageSlot {
 public:
  MessageSlot(const char* channel, const CountLimits& limits, Signal prototype)
      : channel_(channel),
        guard_(channel, layout_of<MessageOf<Signal>>(), limits, 0),
        value(std::move(prototype)) {}

  /// @return false where the log has none. @throws std::runtime_error where it is not this robot's, or of
  /// another version.
  bool read(const Bytes& bytes) {
    if (bytes.empty()) return false;
    const bool good = guard_.decode(bytes.data(), bytes.size(), message_) == Refusal::kNone &&
                      from_message(message_, value);
    if (!good)
      throw std::runtime_error(std::string("the log's ") + channel_ +
                               " is of another robot, or of another version of sprung (LOG_METADATA names "
                               "it), or damaged ('sprung "
                               "log repair' leaves such out): " +
                               guard_.last_refusal());
    return true;
  }

  /// `value` as bytes, with that session.
  const Bytes& write(std::int64_t session) {
    to_message(value, session, message_);
    bytes_.resize(static_cast<std::size_t>(message_.getEncodedSize()));
    message_.encode(bytes_.data(), 0, static_cast<int>(bytes_.size()));
    return bytes_;
  }

  /// Whether what write() made last is what the log has, bit for bit but for the MAC, which replays have not.
  bool same(const Bytes& recorded) const noexcept {
    const std::size_t mac = kHasMac<MessageOf<Signal>> ? kMacBytes : 0;
    return recorded.size() == bytes_.size() && recorded.size() >= mac &&
           std::equal(bytes_.begin(), bytes_.end() - static_cast<std::ptrdiff_t>(mac), recorded.begin());
  }

  const char* channel() const noexcept { return channel_; }

 private:
  const char* channel_;
  ReceiveGuard guard_;
  MessageOf<Signal> message_{};
  Bytes bytes_;

 public:
  Signal value;
};

}  // namespace sprung
