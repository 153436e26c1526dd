#pragma once
/// Checks a message's bytes before they are decoded: LCM's own decoder ends the process on a bad count (facts
/// L7) and reads past the buffer on a bad string length. One guard for each subscription. check() runs in the
/// receiving thread; counters may be read from any thread.
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>

#include "runtime/message_layout.h"
#include "signals/enumeration.h"

namespace sprung {

enum class Refusal : std::int8_t {
  kNone = 0,
  kTooShort,      ///< not even a header and its counts
  kWrongHash,     ///< another type, or another version of it
  kWrongSession,  ///< of another `sprung up`, or a replay
  kBadCount,      ///< negative, or not this robot's
  kWrongLength,   ///< truncated, trailing bytes, or a string that does not fit
  kNotDecodable,  ///< LCM's decoder refused it
  kBadValue,      ///< an enumeration value that is unknown here
};
constexpr auto words_of(Refusal) {
  using E = Refusal;
  return words<E>({{E::kNone, "accepted"},
                   {E::kTooShort, "too short"},
                   {E::kWrongHash, "wrong hash"},
                   {E::kWrongSession, "wrong session"},
                   {E::kBadCount, "bad count"},
                   {E::kWrongLength, "wrong length"},
                   {E::kNotDecodable, "not decodable"},
                   {E::kBadValue, "bad value"}});
}

class ReceiveGuard {
 public:
  /// @param session messages of other sessions are refused; 0 accepts every session (tools that only look).
  ReceiveGuard(std::string channel, const MessageLayout& layout, const CountLimits& limits,
               std::int64_t session);

  /// kNone: decoding these bytes is safe. Counts and remembers what it refuses.
  Refusal check(const void* data, std::size_t size) noexcept;
  /// check(), then decode in place and require every byte consumed. Unless kNone, `out` is unspecified.
  template <class M>
  Refusal decode(const void* data, std::size_t size, M& out) noexcept;
  /// Counts a refusal found later, e.g. kBadValue by from_message.
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
  bool strings_fit(const std::uint8_t* bytes, std::size_t size, std::size_t position) const noexcept;

  std::string channel_;
  MessageLayout layout_;
  CountLimits limits_;
  std::int64_t session_;
  std::atomic<std::int64_t> accepted_{0};
  std::array<std::atomic<std::int64_t>, kWords<Refusal>.size()> refused_{};
  mutable std::mutex last_mutex_;
  Refusal last_ = Refusal::kNone;
  std::int64_t last_found_ = 0;
  std::int64_t last_expected_ = 0;
};

template <class M>
Refusal ReceiveGuard::decode(const void* data, std::size_t size, M& out) noexcept {
  const Refusal refusal = check(data, size);
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
