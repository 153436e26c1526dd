#pragma once
/// Rare messages in order of arrival: operator commands, replies, and all that the tools show. Bounded: what
/// does not fit is dropped and counted. push() in the receiving thread, pop() in the node's thread. Never for
/// what moves a joint.
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

#include "runtime/input_event.h"

namespace sprung {

template <class T>
class InputQueue {
 public:
  explicit InputQueue(std::size_t capacity = 64) : capacity_(capacity) {}

  void push(const T& value) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (values_.size() == capacity_) {
      ++overflow_;
      return;
    }
    values_.push_back(value);
    if (event_ != nullptr) event_->signal();
  }

  std::optional<T> pop() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (values_.empty()) return std::nullopt;
    std::optional<T> first(std::move(values_.front()));
    values_.pop_front();
    return first;
  }

  std::int64_t overflow() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return overflow_;
  }

  /// Signalled by every push; set by Node::subscribe.
  void wake(InputEvent* event) {
    const std::lock_guard<std::mutex> lock(mutex_);
    event_ = event;
  }

 private:
  mutable std::mutex mutex_;
  std::size_t capacity_;
  std::deque<T> values_;
  std::int64_t overflow_ = 0;
  InputEvent* event_ = nullptr;
};

}  // namespace sprung
