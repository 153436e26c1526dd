#pragma once
/// Which robot and which of its buses a tool shall use, and what address each has: as the robot that is up
/// uses it, else robot.yaml's.
#include <optional>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "tools/can/frame_source.h"
#include "tools/operate/launcher/run_file.h"

namespace sprung {

struct BusRequest {
  std::string robot;             ///< name or folder, "" = the one that is up
  std::string bus;               ///< "" = all
  std::vector<std::string> can;  ///< ADDRESS, or BUS=ADDRESS
  std::string instance = "default";
};

/// The run of this instance, when it is of this robot.
std::optional<RunInfo> running_as(const RobotConfig& robot, const std::string& instance);

/// By bus index. @throws std::invalid_argument where `can` names what the robot has not, or leaves open which
/// bus is meant.
std::vector<LiveBus> robot_buses(const RobotConfig& robot, const BusRequest& request);

/// @throws std::invalid_argument naming the buses there are.
int bus_index(const RobotConfig& robot, const std::string& bus);

}  // namespace sprung
