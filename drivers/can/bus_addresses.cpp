#include "drivers/can/bus_addresses.h"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <stdexcept>

namespace sprung {

std::vector<std::string> bus_addresses(const RobotConfig& robot, const std::vector<std::string>& can) {
  std::vector<std::string> addresses;
  for (const BusConfig& bus : robot.buses) {
    addresses.push_back(bus.can);
  }
  for (const std::string& text : can) {
    const std::size_t equals = text.find('=');
    const auto named = [&](const BusConfig& bus) { return bus.name == text.substr(0, equals); };
    const auto bus = std::find_if(robot.buses.begin(), robot.buses.end(), named);
    if (equals == std::string::npos || bus == robot.buses.end()) {
      throw std::invalid_argument("--can " + text +
                                  ": expected BUS=ADDRESS with one of the robot's buses, for example " +
                                  robot.buses.front().name + "=socketcan:can0");
    }
    addresses[bus - robot.buses.begin()] = text.substr(equals + 1);
  }
  return addresses;
}

RobotConfig with_bus_addresses(const RobotConfig& robot, const std::vector<std::string>& can) {
  RobotConfig used = robot;
  const std::vector<std::string> addresses = bus_addresses(robot, can);
  for (std::size_t bus = 0; bus < addresses.size(); ++bus) used.buses[bus].can = addresses[bus];
  return used;
}

std::vector<BurstFault> parse_burst_faults(const std::vector<std::string>& texts) {
  std::vector<BurstFault> faults;
  for (const std::string& text : texts) {
    char kind[16] = "";
    BurstFault fault;
    int end = 0;
    const int found = std::sscanf(text.c_str(), "can-%15[a-z]:%" SCNd64 ":%d%n", kind, &fault.tick,
                                  &fault.index, &end);
    const bool known = std::strcmp(kind, "drop") == 0 || std::strcmp(kind, "repeat") == 0;
    if (found != 3 || !known || end != static_cast<int>(text.size())) {
      throw std::invalid_argument("--inject-can " + text +
                                  ": expected can-drop:TICK:INDEX or can-repeat:TICK:INDEX");
    }
    fault.kind = std::strcmp(kind, "drop") == 0 ? BurstFault::Kind::kDrop : BurstFault::Kind::kRepeat;
    faults.push_back(fault);
  }
  return faults;
}

std::unique_ptr<UdpBus> open_udp_bus(const std::string& address) {
  if (address.rfind("udp:", 0) != 0) {
    throw std::invalid_argument("lock-step runs over a udp: bus, not " + address +
                                ": use --clock realtime there");
  }
  std::unique_ptr<CanBus> bus = open_can_bus(address);
  return std::unique_ptr<UdpBus>(static_cast<UdpBus*>(bus.release()));
}

}  // namespace sprung
