#pragma once
/// The process that writes the log of a run: sprung-recorder, or LCM's own lcm-logger where asked.
#include <string>

#include "tools/operate/launcher/launch_plan.h"
#include "tools/operate/launcher/run_file.h"

namespace sprung {

inline constexpr const char* kRecorderProgram = "sprung-recorder";
inline constexpr const char* kLcmLogger = "lcm-logger";

/// @throws std::invalid_argument where lcm-logger is asked for what it does not know.
void check_recording(const std::string& recorder, const RecordingRequest& recording);

/// Into info.log. @throws as check_recording.
PlannedProcess plan_recorder(const LaunchRequest& request, const RobotConfig& robot, const RunInfo& info);
/// The first file of a recording: x.lcm, or x-000.lcm where it is split.
std::string first_file(const std::string& log, const RecordingRequest& recording);
/// Whether a process publishes PROCESS_STATUS.
bool says_status(const PlannedProcess& planned);

}  // namespace sprung
