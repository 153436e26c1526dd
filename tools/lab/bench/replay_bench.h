#pragma once
/// What a replay costs: `sprung bench replay`.
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "tools/lab/run/experiment_report.h"

namespace sprung {

/// A walking robot gets up, stands and trots in this process; its log is replayed into the cores: how many
/// times real time, bit for bit or not, and what of it is reading the file and what each core, in processor
/// time. @param duration_s of the trot. @param folder for the log.
/// @throws std::runtime_error where the robot does not stand, std::invalid_argument for one that does not
/// walk.
std::vector<ReportRow> bench_replay(const RobotConfig& robot, int runs, double duration_s,
                                    const std::string& folder);

}  // namespace sprung
