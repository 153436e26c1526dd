#include "tools/can/bus_choice.h"

#include <stdexcept>

#include "drivers/can/bus_addresses.h"

namespace sprung {
namespace {

/// A plain address belongs to the bus that was named, or to the only one.
std::vector<std::string> with_bus_names(const RobotConfig& robot, const BusRequest& request) {
  std::vector<std::string> texts;
  for (const std::string& text : request.can) {
    const bool named = text.find('=') != std::string::npos;
    if (!named && request.bus.empty() && robot.buses.size() > 1) {
      throw std::invalid_argument("--can " + text + ": which of this robot's buses? Say " +
                                  robot.buses.front().name + "=" + text + ", or add --bus");
    }
    const std::string& bus = request.bus.empty() ? robot.buses.front().name : request.bus;
    texts.push_back(named ? text : bus + "=" + text);
  }
  return texts;
}

}  // namespace

std::optional<RunInfo> running_as(const RobotConfig& robot, const std::string& instance) {
  std::optional<RunInfo> info = read_run_file(instance);
  if (info && info->robot != robot.name) return std::nullopt;
  return info;
}

int bus_index(const RobotConfig& robot, const std::string& bus) {
  std::string known;
  for (std::size_t i = 0; i < robot.buses.size(); ++i) {
    if (robot.buses[i].name == bus) return static_cast<int>(i);
    known += (i == 0 ? "" : ", ") + robot.buses[i].name;
  }
  throw std::invalid_argument("robot " + robot.name + " has no bus '" + bus + "'; there are: " + known);
}

std::vector<LiveBus> robot_buses(const RobotConfig& robot, const BusRequest& request) {
  std::vector<std::string> overrides;
  if (const std::optional<RunInfo> info = running_as(robot, request.instance)) overrides = info->can;
  const std::vector<std::string> asked = with_bus_names(robot, request);
  overrides.insert(overrides.end(), asked.begin(), asked.end());
  const std::vector<std::string> addresses = bus_addresses(robot, overrides);
  std::vector<LiveBus> buses;
  for (std::size_t i = 0; i < addresses.size(); ++i) buses.push_back({robot.buses[i].name, addresses[i]});
  return buses;
}

}  // namespace sprung
