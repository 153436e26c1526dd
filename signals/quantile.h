#pragma once
/// Medians, worst cases and what lies between them.
#include <algorithm>
#include <cstddef>
#include <vector>

#include "signals/vec3.h"

namespace sprung {

/// One of the values; NaN when there is none. @param share 0 to 1 of the values are smaller.
inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return kNaN;
  const double place = std::min(share * static_cast<double>(values.size()),
                                static_cast<double>(values.size() - 1));
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

}  // namespace sprung
