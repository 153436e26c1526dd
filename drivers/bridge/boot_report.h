#pragma once
/// What boot has done to a node, and what its orderly end has given back, in lines for the log. Allocates.
#include <string>
#include <vector>

#include "drivers/bridge/drive_node.h"

namespace sprung {

/// "hip_motor: boot has overwritten 0x6075:00 rated current (2500, now 7000), ..."; nothing where it has not.
void report_boot(const NodeLink& link, std::vector<std::string>& lines);
/// Of drives that are to get their settings back.
void report_restore(const DriveNode& drive, std::vector<std::string>& lines);

}  // namespace sprung
