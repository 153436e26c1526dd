#pragma once
/// Whether an authentic message is new. A MAC does not tell a message from a copy that somebody kept. Pure;
/// one object for each subscription, fixed storage.
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "runtime/refusal.h"
#include "signals/stamp.h"

namespace sprung {

/// A sender whose seq falls back by more than this has restarted.
inline constexpr std::int64_t kRestartGap = 8;

/// In real time nothing that is true is older: what moves a joint is stale after 20 ms, an operator's client
/// stamps anew whenever it sends again, and 2 s are more than any stall that a robot survives.
inline constexpr std::int64_t kOldest_us = 2'000'000;
/// Processes of one computer share a clock; those of several are held together by NTP within some 10 ms.
inline constexpr std::int64_t kMostAhead_us = 100'000;

/// What a message may be by our clock. @param now_us nothing where times are not the clock's (lock-step).
Refusal by_clock(std::int64_t utime_us, const std::optional<std::int64_t>& now_us) noexcept;

/// Of a channel with one sender and one message a cycle (DRIVE_STATE, JOINT_STATE, LEG_COMMAND,
/// DRIVE_COMMAND, IMU). Among the newest kRestartGap cycles order does not matter; what is older must be a
/// sender that began anew, and is that only when its time is newer than all that was taken.
class CycleFreshness {
 public:
  /// @param now_us by our clock; nothing in lock-step, where a message that comes again is a repeat that the
  /// receiver asked for, and is let through.
  Refusal admit(const Stamp& stamp, const std::optional<std::int64_t>& now_us) noexcept;

 private:
  Refusal judge(const Stamp& stamp, bool repeats_pass) const noexcept;
  void take(const Stamp& stamp) noexcept;

  bool any_ = false;
  Stamp newest_;               ///< greatest seq taken since the sender began, greatest time of all
  std::int64_t began_us_ = 0;  ///< time of the first message of this sender
  std::uint32_t taken_ = 0;    ///< bit n: seq newest - n was taken
};

/// Of a channel with several senders that send now and then (OPERATOR_COMMAND, SIM_CONTROL): each message
/// once. When the memory is full, what is not newer than the newest forgotten counts as late.
class EventFreshness {
 public:
  static constexpr std::size_t kRemembered = 256;
  /// @param repeats_pass the receiver knows repeats by their stamp (SIM_CONTROL).
  explicit EventFreshness(bool repeats_pass) noexcept : repeats_pass_(repeats_pass) {}
  /// @param mac first eight bytes of the message's MAC, which tells it from any other.
  Refusal admit(std::int64_t utime_us, std::uint64_t mac, std::int64_t now_us) noexcept;

 private:
  struct Known {
    std::uint64_t mac = 0;
    std::int64_t utime_us = 0;
  };
  void remember(const Known& known) noexcept;

  bool repeats_pass_;
  std::array<Known, kRemembered> known_{};
  std::size_t count_ = 0;  ///< of all that were taken
  std::optional<std::int64_t> forgotten_us_;
};

}  // namespace sprung
