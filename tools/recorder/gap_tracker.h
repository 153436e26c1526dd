#pragma once
/// Finds cycles that a channel does not have. Pure.
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace sprung {

/// Whether the channel has one message each cycle, as long as its sender keeps up; of the others a missing one cannot be told.
bool has_every_cycle(std::string_view channel) noexcept;

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
  /// @param seq of the message; -1 is before cycle 0 and counts as a message only.
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

}  // namespace sprung
