#pragma once
/// The newest values of a signal, by cycle. Pure.
#include <cstddef>
#include <cstdint>
#include <vector>

namespace sprung {

/// @tparam Signal has a stamp; give a prototype of its size, so that keep() allocates nothing.
template <class Signal>
class History {
 public:
  /// An input that is older than this many cycles was not used: every watchdog is shorter.
  static constexpr std::int64_t kDepth = 256;

  explicit History(const Signal& prototype) : values_(kDepth, prototype) { clear(); }
  void clear() {
    for (Signal& value : values_) value.stamp.seq = -1;
  }
  void keep(const Signal& value) { values_[place(value.stamp.seq)] = value; }
  /// nullptr where it was never kept, or is too old.
  const Signal* find(std::int64_t seq) const {
    if (seq < 0) return nullptr;
    const Signal& value = values_[place(seq)];
    return value.stamp.seq == seq ? &value : nullptr;
  }
  const Signal* newest_at_or_before(std::int64_t seq) const {
    for (std::int64_t k = seq; k >= 0 && k > seq - kDepth; --k) {
      if (const Signal* value = find(k)) return value;
    }
    return nullptr;
  }

 private:
  static std::size_t place(std::int64_t seq) { return static_cast<std::size_t>(seq % kDepth); }
  std::vector<Signal> values_;
};

}  // namespace sprung
