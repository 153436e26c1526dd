#include "tests/fuzz/fuzz.h"

#include <stdexcept>

namespace sprung::fuzz {

std::vector<Target>& targets() {
  static std::vector<Target> all;
  return all;
}

void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

}  // namespace sprung::fuzz
