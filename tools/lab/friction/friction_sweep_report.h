#pragma once
/// A friction sweep for people: its protocol in words, every model beside the others, friction over speed,
/// residuals. Pure.
#include "tools/common/report/report.h"
#include "tools/lab/friction/friction_sweep.h"

namespace sprung {

/// What was done and what the figure means, in a few sentences.
std::vector<std::string> protocol_text(const SweepResult& result);
report::Section sweep_section(const SweepResult& result);
/// Every model's score, for a terminal.
std::string sweep_table(const SweepResult& result);

}  // namespace sprung
