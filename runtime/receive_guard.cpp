#include "runtime/receive_guard.h"

#include <cstring>
#include <utility>

namespace sprung {

ReceiveGuard::ReceiveGuard(std::string channel, const MessageLayout& layout, const CountLimits& limits,
                           std::int64_t session)
    : channel_(std::move(channel)),
      layout_(layout),
      limits_(limits),
      session_(session),
      events_(layout.proof == Proof::kRepeatedEvent) {}

void ReceiveGuard::demand(std::shared_ptr<const MessageKey> key, bool lockstep) {
  if (layout_.proof != Proof::kNone) key_ = std::move(key);
  lockstep_ = lockstep;
}

Refusal ReceiveGuard::check(const void* data, std::size_t size, std::int64_t now_us) noexcept {
  const auto* const bytes = static_cast<const std::uint8_t*>(data);
  std::int64_t found = 0;
  std::int64_t expected = 0;
  Refusal refusal = inspect(bytes, size, found, expected);
  if (refusal == Refusal::kNone && key_ != nullptr) {
    refusal = judge(bytes, size, now_us);
    found = read_int64(bytes, kUtimeOffset);
    expected = now_us;
  }
  if (refusal != Refusal::kNone) refuse(refusal, found, expected);
  return refusal;
}

/// Of a message that is whole: whether it is of somebody who has the key, and new.
Refusal ReceiveGuard::judge(const std::uint8_t* bytes, std::size_t size, std::int64_t now_us) noexcept {
  if (!key_->fits(channel_, bytes, size)) return Refusal::kForged;
  const Stamp stamp{read_int64(bytes, kUtimeOffset), read_int64(bytes, kSeqOffset)};
  if (layout_.proof != Proof::kCycle)
    return events_.admit(stamp.utime_us, static_cast<std::uint64_t>(read_int64(bytes, size - kMacBytes)),
                         now_us);
  return cycles_.admit(stamp, lockstep_ ? std::nullopt : std::optional<std::int64_t>(now_us));
}

Refusal ReceiveGuard::inspect(const std::uint8_t* bytes, std::size_t size, std::int64_t& found,
                              std::int64_t& expected) const noexcept {
  const auto differ = [&](std::int64_t is, std::int64_t should) {
    found = is;
    expected = should;
    return is != should;
  };
  const std::size_t header = kCountsOffset + 4 * static_cast<std::size_t>(layout_.counts);
  if (size < header) {
    differ(static_cast<std::int64_t>(size), static_cast<std::int64_t>(header));
    return Refusal::kTooShort;
  }
  if (differ(read_int64(bytes, 0), layout_.hash)) return Refusal::kWrongHash;
  if (session_ != 0 && differ(read_int64(bytes, kSessionOffset), session_)) return Refusal::kWrongSession;
  std::size_t length = layout_.fixed_size;
  for (std::size_t i = 0; i < static_cast<std::size_t>(layout_.counts); ++i) {
    const std::int32_t count = read_int32(bytes, kCountsOffset + 4 * i);
    differ(count, limits_.most[i]);
    if (count < limits_.least[i] || count > limits_.most[i]) return Refusal::kBadCount;
    length += static_cast<std::size_t>(count) * layout_.element_size[i];
  }
  differ(static_cast<std::int64_t>(size), static_cast<std::int64_t>(length));
  const bool fits = layout_.strings == 0 ? size == length : strings_fit(bytes, size, length);
  return fits ? Refusal::kNone : Refusal::kWrongLength;
}

// A length of zero throws in LCM's decoder, and the smallest negative one makes it read 2 GB past the buffer.
bool ReceiveGuard::strings_fit(const std::uint8_t* bytes, std::size_t size,
                               std::size_t position) const noexcept {
  for (int i = 0; i < layout_.strings; ++i) {
    if (position > size || size - position < 4) return false;
    const std::int32_t length = read_int32(bytes, position);  // with the terminating zero
    position += 4;
    if (length < 1 || static_cast<std::size_t>(length) > size - position) return false;
    const std::size_t end = position + static_cast<std::size_t>(length);
    if (std::memchr(bytes + position, 0, end - position) != bytes + end - 1)
      return false;  // one zero, and last
    position = end;
  }
  return position == size;
}

void ReceiveGuard::refuse(Refusal why, std::int64_t found, std::int64_t expected) noexcept {
  ++refused_[static_cast<std::size_t>(why)];
  const std::lock_guard<std::mutex> lock(last_mutex_);
  last_ = why;
  last_found_ = found;
  last_expected_ = expected;
}

std::int64_t ReceiveGuard::refused() const noexcept {
  std::int64_t sum = 0;
  for (const auto& count : refused_) sum += count.load();
  return sum;
}

std::int64_t ReceiveGuard::refused(Refusal why) const noexcept {
  return refused_[static_cast<std::size_t>(why)].load();
}

std::string ReceiveGuard::last_refusal() const {
  const std::lock_guard<std::mutex> lock(last_mutex_);
  if (last_ == Refusal::kNone) return "";
  const std::string refused = channel_ + " refused: " + name(last_);
  if (last_ == Refusal::kBadValue && last_expected_ == 0) return refused + ", a number beyond its range";
  const bool timely = last_ >= Refusal::kForged && last_ <= Refusal::kFuture;
  const char* const expected = last_ == Refusal::kBadValue ? ", expected 0 to " : ", expected ";
  return refused + (timely ? ", its time " : ", found ") + std::to_string(last_found_) +
         (timely ? ", ours " : expected) + std::to_string(last_expected_);
}

}  // namespace sprung
