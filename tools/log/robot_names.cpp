#include "tools/log/robot_names.h"

#include "robots/robot_loader.h"

namespace sprung::log {

namespace {

template <class Items>
std::vector<std::string> names_of(const Items& items) {
  std::vector<std::string> names;
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

}  // namespace

RobotNames names_of_robot(const std::string& robot) {
  if (robot.empty()) return {};
  try {
    const RobotConfig config = load_robot(robot);
    RobotNames names;
    names.legs = names_of(config.legs);
    names.lists = {{"joints", names_of(config.joints)},
                   {"legs", names.legs},
                   {"actuators", names_of(config.actuators)},
                   {"buses", names_of(config.buses)}};
    return names;
  } catch (const ConfigError&) {
    return {};
  }
}

}  // namespace sprung::log
