#pragma once
/// How long a robot takes to come up: `sprung bench up`.
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "tools/lab/run/experiment_report.h"

namespace sprung {

/// Simulated drives, real time, recorder on, on an LCM port and CAN ports of its own: seconds from the
/// launcher's first act until every process is ready and the bridge runs; and to the end of the last process
/// when stopped. Medians of `runs`, and the slowest.
/// @param log_folder where the recorder writes. @throws std::runtime_error when the robot does not come up.
std::vector<ReportRow> bench_up(const RobotConfig& robot, int runs, const std::string& log_folder);

}  // namespace sprung
