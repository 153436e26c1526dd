#pragma once
/// Messages as a log holds them, for tests.
#include <string>
#include <vector>

#include "signals/messages.h"
#include "tools/logs/log/event.h"
#include "tools/logs/replay/log_cycles.h"

namespace sprung::test {

template <class Signal>
Bytes message_of(const Signal& signal, std::int64_t session = 1) {
  MessageOf<Signal> message;
  to_message(signal, session, message);
  Bytes bytes(static_cast<std::size_t>(message.getEncodedSize()));
  message.encode(bytes.data(), 0, static_cast<int>(bytes.size()));
  return bytes;
}

/// The event points to `bytes`.
inline log::Event event_of(std::string_view channel, const Bytes& bytes, std::int64_t time_us = 1) {
  log::Event event;
  event.channel = channel;
  event.data = bytes.data();
  event.size = bytes.size();
  event.time_us = time_us;
  return event;
}

}  // namespace sprung::test
