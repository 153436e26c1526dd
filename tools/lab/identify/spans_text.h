#pragma once
/// "8:60" and "0:0.25,0.5:0.75" as spans. Pure.
#include <string>
#include <vector>

#include "estimator/identification/raw_series.h"

namespace sprung::identify {

/// @param option for messages, "--window". @throws std::invalid_argument with an example.
std::vector<identification::TimeSpan> parse_spans(const std::string& text, const char* option);

}  // namespace sprung::identify
