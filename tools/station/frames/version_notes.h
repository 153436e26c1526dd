#pragma once
/// What is missing where a log's messages are of another version than this sprung's. Pure.
#include <optional>
#include <string>
#include <vector>

#include "sprung_msgs/log_metadata_t.hpp"
#include "tools/station/frames/frames.h"

namespace sprung::station {

/// Who made the log, "0.1.0 (abc)"; "" where nobody says so.
std::string made_by(const std::optional<sprung_msgs::log_metadata_t>& metadata);

/// A sentence for each channel of which messages could not be decoded. @param maker made_by()
std::vector<std::string> version_notes(const Frames& frames, const std::string& maker);

/// Why no pose may be drawn where no frame had one.
std::string no_pose(const Frames& frames, const std::string& maker);

}  // namespace sprung::station
