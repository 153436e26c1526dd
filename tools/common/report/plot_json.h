#pragma once
/// A plot as data for tools/common/report/report.js, thinned.
#include <string>
#include <vector>

#include "tools/common/report/report.h"

namespace sprung::report {

/// A JSON array of the plots, safe inside a <script>; what is not finite becomes null.
/// @throws std::invalid_argument where x and y are not equally long, naming plot and series.
std::string plots_json(const std::vector<const Plot*>& plots);

}  // namespace sprung::report
