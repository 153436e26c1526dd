#pragma once
/// A field that was asked for and is not in a log: what may have been meant. Shell: reads the log.
#include <string>
#include <vector>

namespace sprung::log {

struct FieldName {
  std::string path;   ///< "JOINT_STATE.joints[0].status"
  std::string named;  ///< "JOINT_STATE.joints[fl_abduction].status", where the robot is known
};

/// Every number and text of the log's first messages.
std::vector<FieldName> field_names(const std::string& log);

/// Of a channel whose message is another version's: that. Else one sentence that names the field, the nearest
/// one that there is, and where all are listed. An index that was typed stays that joint: by letters alone
/// "joints[fl_hip]" is nearer to "joints[0]" than "joints[fl_abduction]", which it is.
std::string no_field_text(const std::string& log, const std::string& field);

}  // namespace sprung::log
