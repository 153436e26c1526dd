#pragma once
/// What is missing where a log's messages are of another version than this sprung's. Pure.
#include <string>
#include <vector>

#include "tools/station/frames/frames.h"

namespace sprung::station {

/// A sentence for each channel of which messages could not be decoded. @param maker log::made_by()
std::vector<std::string> version_notes(const Frames& frames, const std::string& maker);

/// Why no pose may be drawn where no frame had one.
std::string no_pose(const Frames& frames, const std::string& maker);

}  // namespace sprung::station
