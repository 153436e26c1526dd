#pragma once
/// Which address each of a robot's buses has in this run.
#include <memory>
#include <string>
#include <vector>

#include "drivers/can/lockstep_link.h"
#include "drivers/can/udp_bus.h"
#include "robots/robot_config.h"

namespace sprung {

/// Addresses by bus index: robot.yaml's, or the override. @param overrides BUS=ADDRESS.
/// @throws std::invalid_argument naming what is no bus of this robot.
std::vector<std::string> bus_addresses(const RobotConfig& robot, const std::vector<std::string>& overrides);

/// The robot as this run has it: its buses carry the addresses really used, which texts for people then name.
/// @throws as bus_addresses.
RobotConfig with_bus_addresses(const RobotConfig& robot, const std::vector<std::string>& overrides);

/// Lock-step needs a bus whose datagrams can be numbered. @throws std::invalid_argument unless the address is
/// udp:GROUP:PORT.
std::unique_ptr<UdpBus> open_udp_bus(const std::string& address);

/// Tests of the lock-step link. @param texts can-drop:TICK:INDEX or can-repeat:TICK:INDEX, acting on this
/// program's own frames.
/// @throws std::invalid_argument naming the two forms.
std::vector<BurstFault> parse_burst_faults(const std::vector<std::string>& texts);

}  // namespace sprung
