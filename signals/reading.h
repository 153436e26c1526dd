#pragma once
/// What became of a message that was read: good, or the first number in it that this build does not know.
#include <cstdint>

namespace sprung {

struct Reading {
  bool good = true;
  std::int64_t found = 0;    ///< unless good: the number
  std::int64_t largest = 0;  ///< that it could be; 0: no single number is wrong

  explicit operator bool() const noexcept { return good; }
  void refuse(std::int64_t number, std::int64_t most) noexcept {
    if (good) *this = {false, number, most};
  }
};

}  // namespace sprung
