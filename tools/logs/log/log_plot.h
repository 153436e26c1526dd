#pragma once
/// Fields of a log over time, with phases behind them. Shell: reads a file.
#include <string>
#include <vector>

#include "tools/common/report/report.h"
#include "tools/logs/log/field_selection.h"
#include "tools/logs/log/log_info.h"
#include "tools/logs/log/reader.h"
#include "tools/logs/log/time_span.h"

namespace sprung::log {

struct PlotRequest {
  std::vector<std::string> fields;
  std::string phases = "MOTION_STATE.state_name";  ///< a field whose values shade the plots; "" = none
  TimeSpan span;
  std::vector<fields::ListNames> names;  ///< of joints and legs, see robot_names.h
  bool joint_names = true;               ///< curves have them, where they are known
};

struct LogPlot {
  std::string title;
  std::string subtitle;
  /// One for each unit; its title is what the names of its curves have in common.
  std::vector<report::Plot> plots;
  std::vector<std::string> unmatched;  ///< fields that were asked for and are not in the log
};

/// @throws std::invalid_argument where nothing is chosen, or more curves than a plot can show.
LogPlot collect_plot(Reader& reader, const PlotRequest& request, const Progress& progress = {});

/// The page, by tools/common/report.
report::Report plot_report(const LogPlot& plot, const std::string& command);

}  // namespace sprung::log
