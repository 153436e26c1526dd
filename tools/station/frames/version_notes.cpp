#include "tools/station/frames/version_notes.h"

#include <algorithm>

#include "lcmtypes/channels.h"

namespace sprung::station {

namespace {

std::string remedy(const std::string& maker) {
  return "use the sprung that made the log" + (maker.empty() ? "" : ": " + maker);
}

std::string note_of(const Frames::Source& source, const std::string& maker) {
  if (source.decoded == 0)
    return source.channel + " is of another version of its message: its values are missing; " +
           remedy(maker) + ".";
  return std::to_string(source.not_decoded) + " of " + std::to_string(source.decoded + source.not_decoded) +
         " messages of " + source.channel +
         " are damaged or of another version: their values are missing, and what was said before stays.";
}

}  // namespace

std::vector<std::string> version_notes(const Frames& frames, const std::string& maker) {
  std::vector<std::string> notes;
  for (const Frames::Source& source : frames.sources())
    if (source.not_decoded > 0) notes.push_back(note_of(source, maker));
  return notes;
}

std::string no_pose(const Frames& frames, const std::string& maker) {
  const std::vector<Frames::Source>& all = frames.sources();
  const auto joints = std::find_if(all.begin(), all.end(), [](const Frames::Source& source) {
    return source.channel == channels::kJointState;
  });
  const std::string none = "The robot is not drawn, since nothing says where its joints are: ";
  if (joints->decoded > 0) return none + "no joint has a position in JOINT_STATE.";
  if (joints->not_decoded == 0) return none + "there is no JOINT_STATE.";
  return none + "JOINT_STATE is of another version of its message; " + remedy(maker) + ".";
}

}  // namespace sprung::station
