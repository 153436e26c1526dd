#include "tools/operate/launcher/record_command.h"

#include <algorithm>
#include <cstdio>

#include "robots/known_weight.h"

namespace sprung {

std::string record_command(const RobotConfig& robot, const JointConfig& joint) {
  const auto place = std::find_if(robot.joints.begin(), robot.joints.end(),
                                  [&](const JointConfig& one) { return one.name == joint.name; });
  const double weight_kg = known_weight_kg(robot, static_cast<int>(place - robot.joints.begin()));
  const std::string record = "sprung identify --record " + robot.name + " " + joint.name + " --suspended",
                    out = " --out " + joint.name + ".lcm";
  if (!(weight_kg > 0.0)) return record + out;
  char weight[80];
  std::snprintf(weight, sizeof weight, ", and once more with --weight %gkg, clamped to its foot", weight_kg);
  return record + " --loaded" + out + weight;
}

std::string recordings_to_repeat(const RobotConfig& robot, const std::string& note) {
  std::string first;
  std::size_t named = 0;
  for (const JointConfig& joint : robot.joints) {
    if (note.find(" " + joint.name + " (") == std::string::npos) continue;
    if (named++ == 0) first = record_command(robot, joint);
  }
  return first + (named > 1 ? "; the other joints alike" : "");
}

}  // namespace sprung
