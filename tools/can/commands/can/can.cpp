#include <cstdio>

#include "drivers/can/can_interface.h"
#include "robots/robot_loader.h"
#include "tools/can/commands/can/can_commands.h"
#include "tools/commands.h"
#include "tools/logs/log/robot_names.h"

namespace sprung::commands {

namespace {

std::optional<RobotConfig> robot_of_log(const std::string& path) {
  if (!is_lcm_log(path)) return std::nullopt;
  log::Reader reader(path);
  log::LoggedRobot logged = log::robot_in_log(reader);
  if (!logged.robot)
    std::fprintf(stderr,
                 "%s: %s; buses, nodes and objects have numbers and no names: add the robot, or its folder\n",
                 path.c_str(), logged.missing.c_str());
  return std::move(logged.robot);
}

}  // namespace

BusNames names_of(const std::optional<RobotConfig>& robot) {
  if (!robot) return {};
  BusNames names{cantools::describe_buses(*robot), {}};
  for (const BusConfig& bus : robot->buses) names.interfaces.push_back(interface_of(bus.can));
  return names;
}

std::optional<RobotConfig> robot_of(const BusRequest& where, const std::string& log) {
  if (!where.robot.empty()) return load_robot(where.robot);
  if (!log.empty()) return robot_of_log(log);
  const std::optional<RunInfo> info = read_run_file(where.instance);
  if (!info) return std::nullopt;
  return load_robot(info->robot_folder);
}

int chosen_bus(const BusRequest& where, const std::optional<RobotConfig>& robot, const FrameSource& source) {
  if (where.bus.empty()) return -1;
  if (robot) return bus_index(*robot, where.bus);
  for (std::size_t i = 0; i < source.buses().size(); ++i) {
    if (source.buses()[i] == where.bus) return static_cast<int>(i);
  }
  throw WrongUse("--bus " + where.bus +
                 ": which robot's? Name it first, for example: sprung can dump single_leg");
}

void tell_losses(const FrameSource& source) {
  const std::string losses = source.losses();
  if (!losses.empty()) std::fprintf(stderr, "%s\n", losses.c_str());
}

void add_can(CommandLine& sprung) {
  CommandLine& can = sprung.subcommand("can",
                                       "Look at CAN frames, live or recorded; give a device its node id.");
  can.example("sprung can dump single_leg");
  add_can_dump(can);
  add_can_export(can);
  add_can_lss(can);
}

}  // namespace sprung::commands
