#include "tools/logs/log/robot_names.h"

#include "lcmtypes/channels.h"
#include "robots/maintenance.h"
#include "robots/robot_loader.h"
#include "runtime/process_options.h"
#include "tools/logs/fields/decoder.h"
#include "tools/logs/log/log_info.h"

namespace sprung::log {

namespace {

template <class Items>
std::vector<std::string> names_of(const Items& items) {
  std::vector<std::string> names;
  names.reserve(items.size());
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

/// What a process says of its robot.
struct Hello {
  std::string robot;  ///< "" where nobody says
  std::int64_t configuration_hash = 0;
};

Hello read_hello(const fields::MessageView& message) {
  Hello hello;
  const int robot = message.layout()->find("robot");
  const int hash = message.layout()->find("configuration_hash");
  if (robot == fields::Layout::kNone || hash == fields::Layout::kNone) return hello;
  hello.robot = message.text(message.fields()[robot]);
  hello.configuration_hash = message.integer(message.fields()[hash]);
  return hello;
}

/// The first among the first events. Leaves the reader at its begin.
Hello first_hello(Reader& reader) {
  fields::Decoder decoder;
  fields::MessageView message;
  Hello hello;
  Event event;
  for (int i = 0; i < kEventsToLookAt && hello.robot.empty() && reader.next(event); ++i) {
    if (event.channel != channels::kProcessStatus) continue;
    if (decoder.open(event.data, event.size, message) == fields::Fault::kNone) hello = read_hello(message);
  }
  reader.rewind();
  return hello;
}

bool made_as_it_is(const RobotConfig& robot, std::int64_t hash) {
  // Where there is nothing to preset it is called none; logs from before that say best.
  if (robot.presets.empty())
    return configuration_hash(robot, robot.preset().name) == hash ||
           configuration_hash(robot, "best") == hash;
  for (const PresetConfig& preset : robot.presets)
    if (configuration_hash(robot, preset.name) == hash) return true;
  return false;
}

bool made_with(const RobotConfig& robot, std::int64_t hash) {
  return made_as_it_is(robot, hash) || made_as_it_is(for_maintenance(robot), hash);
}

/// Of a log without robot.yaml.
LoggedRobot robot_of_hello(const Hello& hello) {
  if (hello.robot.empty())
    return {std::nullopt, "no robot.yaml is in it, and no process says of which robot it is"};
  const std::string none = "no robot.yaml is in it, and ";
  try {
    RobotConfig robot = load_robot(hello.robot);
    if (made_with(robot, hello.configuration_hash)) return {std::move(robot), ""};
    return {std::nullopt, none + robot.folder + "/robot.yaml is another than the one that it was made with"};
  } catch (const ConfigError& error) {
    return {std::nullopt, none + error.what()};
  }
}

}  // namespace

LoggedRobot robot_in_log(Reader& reader) {
  const auto metadata = find_metadata(reader);
  if (!metadata || metadata->robot_yaml.empty()) return robot_of_hello(first_hello(reader));
  try {
    return {read_robot_text(metadata->robot_yaml, "robot.yaml in it"), ""};
  } catch (const ConfigError& error) {
    return {std::nullopt, std::string("this sprung cannot read its robot.yaml: ") + error.what()};
  }
}

RobotNames names_of_robot(const RobotConfig& robot) {
  RobotNames names;
  names.legs = names_of(robot.legs);
  names.lists = {{"joints", names_of(robot.joints)},
                 {"legs", names.legs},
                 {"actuators", names_of(robot.actuators)},
                 {"buses", names_of(robot.buses)}};
  return names;
}

RobotNames names_in_log(Reader& reader) {
  const LoggedRobot logged = robot_in_log(reader);
  if (logged.robot) return names_of_robot(*logged.robot);
  RobotNames none;
  none.missing = reader.path() + ": " + logged.missing +
                 "; joints, legs and actuators have numbers and no names: say joints[0], not joints[knee]";
  return none;
}

}  // namespace sprung::log
