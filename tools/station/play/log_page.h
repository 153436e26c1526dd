#pragma once
/// A log as a page that plays it. Shell: reads the log and the robot's files.
#include <string>

#include "tools/logs/log/log_info.h"
#include "tools/logs/log/reader.h"
#include "tools/station/play/log_columns.h"

namespace sprung::station {

struct LogPage {
  std::string html;
  std::vector<std::string> notes;  ///< what the page says about itself: what was dropped or is not known
};

/// @throws std::runtime_error where the log has nothing to show: no cycle, or no robot; it says which, and
/// what to do.
LogPage make_log_page(log::Reader& reader, const log::Progress& progress = {},
                      const ColumnLimits& limits = {});

}  // namespace sprung::station
