#pragma once
/// A recording made in this process as an LCM log, as lcm-logger would have written it. Writes files.
#include <string>
#include <vector>

#include "signals/drive_state.h"

namespace sprung::identify {

/// DRIVE_STATE of every cycle, stamped with the robot's own time: the same bytes for the same states, so that
/// anyone can make the log again and compare its hash. @throws std::runtime_error when it cannot be written.
void write_drive_log(const std::string& path, const std::vector<DriveState>& states);

}  // namespace sprung::identify
