#pragma once
/// The process that writes the log of a run: sprung-recorder, or LCM's own lcm-logger where asked.
#include <string>

#include "tools/launcher/launch_plan.h"
#include "tools/launcher/run_file.h"

namespace sprung {

inline constexpr const char* kRecorderProgram = "sprung-recorder";
inline constexpr const char* kLcmLogger = "lcm-logger";

/// Into info.log.
PlannedProcess plan_recorder(const LaunchRequest& request, const RobotConfig& robot, const RunInfo& info);
/// Whether a process publishes PROCESS_STATUS.
bool says_status(const PlannedProcess& planned);

}  // namespace sprung
