#pragma once
/// Faults of the link on demand, for tests: `--inject drop-rx:LEG_COMMAND:100`. Pure. Each acts on the first
/// occurrence only.
#include <cstdint>
#include <string>
#include <vector>

namespace sprung {

enum class LinkFault { kNone, kDropReceived, kDropSent, kRepeatSent };

class FaultInjection {
 public:
  /// @param texts drop-rx:CHANNEL:SEQ, drop-tx:CHANNEL:SEQ or repeat-tx:CHANNEL:SEQ.
  /// @throws std::invalid_argument naming the text and the three forms.
  explicit FaultInjection(const std::vector<std::string>& texts = {});

  /// What shall happen to this message; forgets the fault. Receiving and sending threads use disjoint
  /// entries.
  LinkFault on_receive(const std::string& channel, std::int64_t seq) noexcept;
  LinkFault on_publish(const std::string& channel, std::int64_t seq) noexcept;

 private:
  struct Entry {
    LinkFault fault = LinkFault::kNone;
    std::string channel;
    std::int64_t seq = -1;
  };
  static LinkFault take(std::vector<Entry>& entries, const std::string& channel, std::int64_t seq) noexcept;
  std::vector<Entry> receiving_;
  std::vector<Entry> sending_;
};

}  // namespace sprung
