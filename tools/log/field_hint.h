#pragma once
/// A field that was asked for and is not in a log: what may have been meant. Shell: reads the log.
#include <string>
#include <vector>

namespace sprung::log {

/// "CHANNEL.path" of every number and text, with names of joints and legs where the robot is known, of the log's first messages.
std::vector<std::string> field_names(const std::string& log);

/// One sentence that names the field, the nearest one that there is, and where all are listed.
std::string no_field_text(const std::string& log, const std::string& field);

}  // namespace sprung::log
