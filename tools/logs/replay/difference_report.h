#pragma once
/// What a replay, or two logs, have different: for the terminal, for scripts, and as a page with plots. Pure.
#include <string>

#include "tools/common/report/report.h"
#include "tools/logs/replay/log_diff.h"
#include "tools/logs/replay/replay_run.h"

namespace sprung {

/// Lines for the terminal; the verdict, "identical" or the first difference, stands in a line of its own.
std::string replay_text(const ReplayRequest& request, const ReplayResult& result);
std::string replay_json(const ReplayRequest& request, const ReplayResult& result);
std::string diff_text(const DiffRequest& request, const DiffResult& result);

/// Pages; the results need courses. @param command the line that makes the page again.
report::Report replay_page(const ReplayRequest& request, const ReplayResult& result,
                           const std::string& command);
report::Report diff_page(const DiffRequest& request, const DiffResult& result, const std::string& command);

}  // namespace sprung
