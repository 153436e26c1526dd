#pragma once
/// What `sprung experiment tune` shows: tables, a page with plots, rows, and a fragment of robot.yaml. Pure.
#include <string>

#include "tools/common/report/report.h"
#include "tools/lab/run/experiment_report.h"
#include "tools/lab/tune/tune.h"

namespace sprung {

/// The best ten, what they traded, and the best beside the present on plants that were not tuned on.
std::string tune_table(const TuneSpace& space, const TuneRequest& request, const TuneResult& result);

/// tune.<present|best>.<quantity> on the plants of `seed`, and tune.best.<key>, the values found.
std::vector<ReportRow> tune_rows(const TuneSpace& space, const TuneResult& result);

/// Keys of robot.yaml with the values found, and a comment that says how. @param command that repeats it.
std::string tune_fragment(const TuneSpace& space, const TuneRequest& request, const TuneResult& result,
                          const std::string& command);

/// Sections of the page: summary, the best ten, trade, cost over each parameter.
std::vector<report::Section> tune_sections(const TuneSpace& space, const TuneRequest& request,
                                           const TuneResult& result);

}  // namespace sprung
