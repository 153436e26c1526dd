#pragma once
/// Cycles that are told by their stretches: "2 cycles: 7, 9" or "1030 cycles: 5 to 1033, 2000". Pure.
#include <cstdint>
#include <string>
#include <vector>

namespace sprung::log {

struct CycleStretch {
  std::int64_t first = -1;
  std::int64_t last = -1;  ///< inclusive
};

class CycleStretches {
 public:
  /// In ascending order; a stretch that follows the one before without a gap is the same. What does not
  /// ascend is no news.
  void add(std::int64_t first, std::int64_t last);
  void add(std::int64_t seq) { add(seq, seq); }

  std::int64_t cycles() const noexcept { return cycles_; }
  bool empty() const noexcept { return cycles_ == 0; }
  std::int64_t stretches() const noexcept { return stretches_; }
  /// The first few.
  const std::vector<CycleStretch>& first() const noexcept { return first_; }
  /// Whether the newest stretch has all of these.
  bool newest_has(std::int64_t first, std::int64_t last) const noexcept {
    return newest_.first <= first && last <= newest_.last;
  }
  /// "5 to 1033, 2000 and 3 stretches more"
  std::string text() const;
  /// From now on numbers may be low again.
  void begin_anew() noexcept { newest_ = {-2, -2}; }

 private:
  static constexpr std::size_t kShown = 5;

  std::int64_t cycles_ = 0;
  std::int64_t stretches_ = 0;
  CycleStretch newest_{-2, -2};
  std::vector<CycleStretch> first_;
};

}  // namespace sprung::log
