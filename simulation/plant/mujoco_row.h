#pragma once
/// MuJoCo keeps vectors of all bodies, geoms, ... in flat arrays.
#include <mujoco/mujoco.h>

#include <cstddef>

#include "signals/vec3.h"

namespace sprung::sim {

/// Where the values of item `index` begin. @param width values for each item, e.g. 3.
template <typename Value>
Value* row(Value* array, int index, int width) noexcept {
  return array + static_cast<std::ptrdiff_t>(index) * width;
}

inline Vec3 vec3(const mjtNum* values) noexcept { return {values[0], values[1], values[2]}; }

}  // namespace sprung::sim
