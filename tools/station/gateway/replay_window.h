#pragma once
/// Which numbers of a counting sender have come: each once, in any order, none that is far behind. Pure.
#include <bitset>
#include <cstddef>
#include <cstdint>

namespace sprung::gateway {

class ReplayWindow {
 public:
  /// A network that reorders by 0.2 s, at 500 datagrams a second, twice as much.
  static constexpr std::size_t kBehind = 256;

  /// Whether it is new; changes nothing.
  bool is_new(std::uint64_t number) const noexcept {
    if (number > newest_) return true;
    const std::uint64_t behind = newest_ - number;
    return number > 0 && behind < kBehind && !seen_[static_cast<std::size_t>(behind)];
  }
  /// Of a new one that turned out to be genuine.
  void take(std::uint64_t number) noexcept {
    if (number > newest_) {
      const std::uint64_t by = number - newest_;
      seen_ = by < kBehind ? seen_ << static_cast<std::size_t>(by) : std::bitset<kBehind>();
      newest_ = number;
    }
    seen_.set(static_cast<std::size_t>(newest_ - number));
  }

 private:
  std::uint64_t newest_ = 0;  ///< senders count from 1
  std::bitset<kBehind> seen_{};
};

}  // namespace sprung::gateway
