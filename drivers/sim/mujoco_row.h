#pragma once
/// MuJoCo keeps vectors of all bodies, geoms, ... in flat arrays.
#include <cstddef>

namespace sprung::sim {

/// Where the values of item `index` begin. @param width values for each item, e.g. 3.
template <typename Value>
Value* row(Value* array, int index, int width) noexcept {
  return array + static_cast<std::ptrdiff_t>(index) * width;
}

}  // namespace sprung::sim
