#pragma once
/// What became of a message that was read: good, or which number is none that this build knows.
#include <cstdint>

namespace sprung {

struct Reading {
  bool good = true;
  std::int64_t found = 0;    ///< unless good: the number
  std::int64_t largest = 0;  ///< that it could be; 0: no single number is wrong

  Reading() = default;
  Reading(bool is_good)
      : good(is_good) {}  // NOLINT(google-explicit-constructor): as functions that have no number say
  operator bool() const noexcept {
    return good;
  }  // NOLINT(google-explicit-constructor): asked as a truth everywhere
  void refuse(std::int64_t number, std::int64_t most) noexcept {
    if (!good) return;  // the first one counts
    good = false;
    found = number;
    largest = most;
  }
};

}  // namespace sprung
