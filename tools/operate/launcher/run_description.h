#pragma once
/// What stands in the run file: of a run that begins, and of one that another host's launcher began.
#include <cstdint>
#include <string>

#include "tools/operate/launcher/launch_plan.h"
#include "tools/operate/launcher/run_file.h"

namespace sprung {

/// @throws std::invalid_argument where --can names no bus of the robot.
RunInfo describe_run(const LaunchRequest& request, const RobotConfig& robot);
/// Waits for the launcher that has the bridge. @throws std::runtime_error when none is heard in
/// request.timeout_s, or the clocks of the two hosts are far apart.
RunInfo describe_joined_run(const LaunchRequest& request, const RobotConfig& robot);

/// FOLDER/ROBOT-DATE-TIME.lcm, a name that no file has yet; makes the folder.
std::string log_path(const std::string& folder, const std::string& robot);
/// Of the processes' lines, beside their log: x.lcm gives x.txt.
std::string lines_path(const std::string& log);

/// A session id that no earlier run had.
std::int64_t random_session();
/// Whether an LCM url and a CAN address are free of other instances is the caller's matter; these give
/// hermetic ones.
std::string lcm_url_on_port(int port);

}  // namespace sprung
