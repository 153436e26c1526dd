#include "runtime/fault_injection.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <utility>

namespace sprung {
namespace {

LinkFault fault_named(const std::string& text) {
  if (text == "drop-rx") return LinkFault::kDropReceived;
  if (text == "drop-tx") return LinkFault::kDropSent;
  if (text == "repeat-tx") return LinkFault::kRepeatSent;
  return LinkFault::kNone;
}

}  // namespace

FaultInjection::FaultInjection(const std::vector<std::string>& texts) {
  for (const std::string& text : texts) {
    const std::size_t first = text.find(':');
    const std::size_t last = text.rfind(':');
    Entry entry;
    if (first != std::string::npos && last > first + 1) {
      entry.fault = fault_named(text.substr(0, first));
      entry.channel = text.substr(first + 1, last - first - 1);
    }
    const char* const end = text.data() + text.size();
    const char* const number = last == std::string::npos ? end : text.data() + last + 1;
    const auto [stop, error] = std::from_chars(number, end, entry.seq);
    if (entry.fault == LinkFault::kNone || error != std::errc() || stop != end) {
      throw std::invalid_argument("injection '" + text +
                                  "': use drop-rx:CHANNEL:SEQ, drop-tx:CHANNEL:SEQ or repeat-tx:CHANNEL:SEQ");
    }
    (entry.fault == LinkFault::kDropReceived ? receiving_ : sending_).push_back(entry);
  }
}

LinkFault FaultInjection::on_receive(const std::string& channel, std::int64_t seq) noexcept {
  return take(receiving_, channel, seq);
}

LinkFault FaultInjection::on_publish(const std::string& channel, std::int64_t seq) noexcept {
  return take(sending_, channel, seq);
}

LinkFault FaultInjection::take(std::vector<Entry>& entries, const std::string& channel,
                               std::int64_t seq) noexcept {
  const auto found = std::find_if(entries.begin(), entries.end(), [&](const Entry& entry) {
    return entry.fault != LinkFault::kNone && entry.seq == seq && entry.channel == channel;
  });
  if (found == entries.end()) return LinkFault::kNone;
  return std::exchange(found->fault, LinkFault::kNone);
}

}  // namespace sprung
