#pragma once
/// Where a received signal waits for its reader: the last four values by cycle, never a queue, so nothing
/// that moves a joint can be old without the reader knowing it. push() in the receiving thread, all else in
/// the node's thread.
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <mutex>
#include <optional>
#include <utility>

#include "runtime/freshness.h"
#include "runtime/input_event.h"

namespace sprung {

/// Seqs held by a slot, ascending.
struct HeldSeqs {
  std::array<std::int64_t, 4> seqs{};
  int count = 0;
  bool has(std::int64_t seq) const noexcept { return std::find(begin(), end(), seq) != end(); }
  std::int64_t newest(std::int64_t if_empty) const noexcept { return count == 0 ? if_empty : *(end() - 1); }
  void add(std::int64_t seq) noexcept {
    int place = count++;
    for (; place > 0 && seqs[place - 1] > seq; --place) seqs[place] = seqs[place - 1];
    seqs[place] = seq;
  }
  const std::int64_t* begin() const noexcept { return seqs.data(); }
  const std::int64_t* end() const noexcept { return seqs.data() + count; }
};

/// T has a `stamp` and is copied, so give a prototype of the size that will be received: then nothing
/// allocates later.
template <class T>
class Slot {
 public:
  static constexpr int kDepth = 4;
  explicit Slot(const T& prototype) { values_.fill(prototype); }

  /// Keeps the value, unless its seq is held already (then it is a repeat: the first one stays and the repeat
  /// is marked) or it is older than all four held (then it is late). A seq that falls back by more than
  /// kRestartGap empties the slot first.
  void push(const T& value);
  /// Copies into `out`. @return false when there is no such value.
  bool get(std::int64_t seq, T& out) const;
  bool newest(T& out) const;
  bool newest_at_or_before(std::int64_t seq, T& out) const;
  HeldSeqs held() const;
  /// Newest seq that came again since the last call.
  std::optional<std::int64_t> take_repeated();
  std::int64_t late() const;     ///< values that were older than all held
  void wake(InputEvent* event);  ///< signalled by every push; set by Node::subscribe

 private:
  int find_newest(std::int64_t limit) const;
  int place_for(std::int64_t seq) const;

  mutable std::mutex mutex_;
  std::array<T, kDepth> values_;
  std::array<bool, kDepth> used_{};
  std::optional<std::int64_t> repeated_;
  std::int64_t late_ = 0;
  InputEvent* event_ = nullptr;
};

template <class T>
int Slot<T>::place_for(std::int64_t seq) const {
  int oldest = 0;
  for (int i = 0; i < kDepth; ++i) {
    if (!used_[i]) return i;
    if (values_[i].stamp.seq < values_[oldest].stamp.seq) oldest = i;
  }
  return values_[oldest].stamp.seq < seq ? oldest : -1;
}

template <class T>
int Slot<T>::find_newest(std::int64_t limit) const {
  int best = -1;
  for (int i = 0; i < kDepth; ++i) {
    if (!used_[i] || values_[i].stamp.seq > limit) continue;
    if (best < 0 || values_[i].stamp.seq > values_[best].stamp.seq) best = i;
  }
  return best;
}

template <class T>
void Slot<T>::push(const T& value) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::int64_t seq = value.stamp.seq;
  const int newest = find_newest(std::numeric_limits<std::int64_t>::max());
  if (newest >= 0 && seq < values_[newest].stamp.seq - kRestartGap) used_.fill(false);
  const int same = find_newest(seq);
  if (same >= 0 && values_[same].stamp.seq == seq) {
    repeated_ = std::max(seq, repeated_.value_or(seq));
  } else if (const int place = place_for(seq); place >= 0) {
    values_[place] = value;
    used_[place] = true;
  } else {
    ++late_;
  }
  if (event_ != nullptr) event_->signal();
}

template <class T>
bool Slot<T>::newest_at_or_before(std::int64_t seq, T& out) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const int found = find_newest(seq);
  if (found < 0) return false;
  out = values_[found];
  return true;
}

template <class T>
bool Slot<T>::get(std::int64_t seq, T& out) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const int found = find_newest(seq);
  if (found < 0 || values_[found].stamp.seq != seq) return false;
  out = values_[found];
  return true;
}

template <class T>
bool Slot<T>::newest(T& out) const {
  return newest_at_or_before(std::numeric_limits<std::int64_t>::max(), out);
}

template <class T>
HeldSeqs Slot<T>::held() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  HeldSeqs held;
  for (int i = 0; i < kDepth; ++i) {
    if (used_[i]) held.add(values_[i].stamp.seq);
  }
  return held;
}

template <class T>
std::optional<std::int64_t> Slot<T>::take_repeated() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(repeated_, std::nullopt);
}

template <class T>
std::int64_t Slot<T>::late() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return late_;
}

template <class T>
void Slot<T>::wake(InputEvent* event) {
  const std::lock_guard<std::mutex> lock(mutex_);
  event_ = event;
}

}  // namespace sprung
