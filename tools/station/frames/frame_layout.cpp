#include "tools/station/frames/frame_layout.h"

#include <nlohmann/json.hpp>

namespace sprung::station {

namespace {

template <class Items>
nlohmann::json names_of(const Items& items) {
  nlohmann::json names = nlohmann::json::array();
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

}  // namespace

nlohmann::json frame_layout(const RobotConfig& robot, const std::vector<FrameField>& fields) {
  nlohmann::json layout{{"robot", robot.name},
                        {"cycle_s", robot.cycle_s},
                        {"joints", names_of(robot.joints)},
                        {"legs", names_of(robot.legs)},
                        {"actuators", names_of(robot.actuators)},
                        {"fields", nlohmann::json::array()}};
  for (const FrameField& field : fields) {
    nlohmann::json one{{"name", field.name}, {"unit", field.unit}};
    for (const auto& [value, word] : field.words) one["words"][std::to_string(value)] = word;
    layout["fields"].push_back(std::move(one));
  }
  return layout;
}

}  // namespace sprung::station
