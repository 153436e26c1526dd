#pragma once
/// What `sprung log` costs on a long log: `sprung bench log`.
#include <cstdint>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "tools/lab/run/experiment_report.h"

namespace sprung {

/// The log of a legged robot that gets up and stands, in this process. @return its path in `folder`.
std::string record_short_log(const RobotConfig& robot, double duration_s, const std::string& folder);

/// The events of `log` again and again until the file has so many bytes; each time as another session, later.
/// @throws std::invalid_argument where the log has no events, log::WriteError where the disk is full.
void repeat_log(const std::string& log, const std::string& out, std::uint64_t bytes);

/// MB of the log a second for each tool (median of the runs, the log in the page cache), beside reading the
/// file alone; and the most memory that this process has had. Tables and MCAP are made and counted, not
/// written. @throws std::runtime_error where it cannot be read.
std::vector<ReportRow> bench_log(const std::string& log, int runs);

}  // namespace sprung
