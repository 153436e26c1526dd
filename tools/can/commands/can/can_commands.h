#pragma once
/// The parts of `sprung can`, one file each, and where frames and their names come from.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "runtime/command_line.h"
#include "tools/can/bus_choice.h"
#include "tools/can/decode/bus_description.h"
#include "tools/can/frame_source.h"

namespace sprung::commands {

void add_can_dump(CommandLine& can);
void add_can_export(CommandLine& can);
void add_can_lss(CommandLine& can);

/// Names of nodes and objects, of buses and interfaces: of the robot, or of nothing.
struct BusNames {
  cantools::BusDescription description;
  std::vector<std::string> interfaces;  ///< "can0" of socketcan:can0, else ""
};
BusNames names_of(const std::optional<RobotConfig>& robot);

/// The robot that was named, of the robot.yaml in the log, or that is up. Where a log has none, says so on
/// standard error: there are numbers instead of names. @param log "" = live. @throws ConfigError where it was
/// named and is not there.
std::optional<RobotConfig> robot_of(const BusRequest& where, const std::string& log);

/// -1 = all. @throws WrongUse where the one named is not there.
int chosen_bus(const BusRequest& where, const std::optional<RobotConfig>& robot, const FrameSource& source);

/// On standard error, where frames were lost.
void tell_losses(const FrameSource& source);

}  // namespace sprung::commands
