#pragma once
/// The answers of the last two cycles, to be sent again when a message was lost.
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace sprung {

/// T has a `stamp` and is copied; give a prototype of its size so that keep() allocates nothing.
template <class T>
class AnswerStore {
 public:
  explicit AnswerStore(const T& prototype) : answers_{prototype, prototype} {}
  void keep(const T& answer) {
    std::swap(answers_[0], answers_[1]);
    answers_[1] = answer;
    held_ = held_ < 2 ? held_ + 1 : 2;
  }
  void clear() noexcept { held_ = 0; }
  /// @return nullptr when that cycle's answer is not stored.
  const T* find(std::int64_t seq) const noexcept {
    for (std::size_t i = 2 - held_; i < 2; ++i) {
      if (answers_[i].stamp.seq == seq) return &answers_[i];
    }
    return nullptr;
  }

 private:
  std::array<T, 2> answers_;  ///< newest last
  std::size_t held_ = 0;
};

}  // namespace sprung
