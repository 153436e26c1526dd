#pragma once
/// Checks a message's bytes before they are decoded: LCM's own decoder ends the process on a bad count (facts
/// L7) and reads past the buffer on a bad string length. One guard for each subscription. check() runs in the
/// receiving thread; counters may be read from any thread.
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "runtime/freshness.h"
#include "runtime/message_key.h"
#include "runtime/message_layout.h"
#include "runtime/refusal.h"

namespace sprung {

class ReceiveGuard {
 public:
  /// @param session messages of other sessions are refused; 0 accepts every session (tools that only look).
  ReceiveGuard(std::string channel, const MessageLayout& layout, const CountLimits& limits,
               std::int64_t session);

  /// From now on messages of a type that carries a MAC must have the right one, and be new (freshness.h).
  /// @param lockstep times of cycles are not the clock's.
  void demand(std::shared_ptr<const MessageKey> key, bool lockstep);

  /// kNone: decoding these bytes is safe. Counts and remembers what it refuses.
  /// @param now_us session's time; of no matter without demand().
  Refusal check(const void* data, std::size_t size, std::int64_t now_us = 0) noexcept;
  /// check(), then decode in place and require every byte consumed. Unless kNone, `out` is unspecified.
  template <class M>
  Refusal decode(const void* data, std::size_t size, M& out, std::int64_t now_us = 0) noexcept;
  /// Counts a refusal found later: kBadValue by from_message, whose Reading has both numbers (0 expected: no
  /// single number is wrong).
  void refuse(Refusal why, std::int64_t found, std::int64_t expected) noexcept;

  const std::string& channel() const noexcept { return channel_; }
  std::int64_t accepted() const noexcept { return accepted_.load(); }
  std::int64_t refused() const noexcept;
  std::int64_t refused(Refusal why) const noexcept;
  /// "JOINT_STATE refused: wrong length, found 17, expected 412"; empty when nothing was refused.
  std::string last_refusal() const;

 private:
  Refusal inspect(const std::uint8_t* bytes, std::size_t size, std::int64_t& found,
                  std::int64_t& expected) const noexcept;
  Refusal judge(const std::uint8_t* bytes, std::size_t size, std::int64_t now_us) noexcept;
  bool strings_fit(const std::uint8_t* bytes, std::size_t size, std::size_t position) const noexcept;

  std::string channel_;
  MessageLayout layout_;
  CountLimits limits_;
  std::int64_t session_;
  std::shared_ptr<const MessageKey> key_;  ///< unless every message is believed
  bool lockstep_ = false;
  CycleFreshness cycles_;
  EventFreshness events_;
  std::atomic<std::int64_t> accepted_{0};
  std::array<std::atomic<std::int64_t>, kWords<Refusal>.size()> refused_{};
  mutable std::mutex last_mutex_;
  Refusal last_ = Refusal::kNone;
  std::int64_t last_found_ = 0;
  std::int64_t last_expected_ = 0;
};

template <class M>
Refusal ReceiveGuard::decode(const void* data, std::size_t size, M& out, std::int64_t now_us) noexcept {
  const Refusal refusal = check(data, size, now_us);
  if (refusal != Refusal::kNone) return refusal;
  int consumed = -1;
  try {
    consumed = out.decode(data, 0, static_cast<int>(size));
  } catch (...) {
    consumed = -1;  // out of memory, or a decoder bug: refused below like any other
  }
  if (consumed == static_cast<int>(size)) {
    ++accepted_;
    return Refusal::kNone;
  }
  refuse(Refusal::kNotDecodable, consumed, static_cast<std::int64_t>(size));
  return Refusal::kNotDecodable;
}

}  // namespace sprung
