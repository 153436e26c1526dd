#pragma once
/// Finds cycles that a channel does not have. Pure.
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>

namespace sprung {

/// Whether the channel has one message each cycle, as long as its sender keeps up; of the others a missing
/// one cannot be told.
bool has_every_cycle(std::string_view channel) noexcept;

/// Two thousand years of 500 Hz. A message that names a later cycle is damaged; sums of gaps up to here do
/// not overflow.
inline constexpr std::int64_t kLastCycle = std::int64_t{1} << 45;

struct GapCounts {
  std::int64_t messages = 0;
  std::int64_t repeats = 0;         ///< cycles that came again: lock-step repairs losses so
  std::int64_t gaps = 0;            ///< stretches without a message
  std::int64_t missing = 0;         ///< cycles in them that never came; one that came late is none
  std::int64_t restarts = 0;        ///< the bridge counts from 0 again
  std::int64_t first_missing = -1;  ///< cycle
};

/// The cycles of one channel, in the order in which its messages came.
class GapTracker {
 public:
  /// @param seq of the message; -1 is before cycle 0 and counts as a message only, as does one that no robot
  /// can reach (damage).
  /// @return how many cycles are missing that were not before this message: 0 nearly always.
  std::int64_t add(std::int64_t seq) noexcept;
  const GapCounts& counts() const noexcept { return counts_; }

 private:
  /// A message that comes later than this many cycles counts as a repeat.
  static constexpr std::int64_t kWindow = 1024;
  static std::size_t place(std::int64_t seq) noexcept { return static_cast<std::size_t>(seq % kWindow); }
  void came_late(std::int64_t seq) noexcept;
  std::int64_t came_ahead(std::int64_t seq) noexcept;

  std::optional<std::int64_t> newest_;
  std::bitset<kWindow> seen_;  ///< of the last kWindow cycles
  GapCounts counts_;
};

/// The same where messages of several sessions may be on the channel: logs that were joined, two robots. Each
/// has cycles of its own.
class SessionGapTracker {
 public:
  std::int64_t add(std::int64_t session, std::int64_t seq) { return sessions_[session].add(seq); }
  GapCounts counts() const
      noexcept;  ///< of all sessions; first_missing of the session with the lowest number that misses any

 private:
  std::map<std::int64_t, GapTracker> sessions_;
};

}  // namespace sprung
