#pragma once
/// Which identifiers an endpoint wants to see: a frame passes when (id & mask) == (filter.id & mask) for one
/// of the filters. Error frames always pass. Pure.
#include <cstdint>
#include <vector>

namespace sprung {

struct RobotConfig;

struct CanFilter {
  std::uint32_t id = 0;
  std::uint32_t mask = 0x7FF;  ///< default: this identifier alone
};

/// @param count 0 = no filter, everything passes.
bool passes(const CanFilter* filters, int count, std::uint32_t id) noexcept;

/// What the bridge has to see of one bus:
///   - every frame to or from the robot's nodes there (CiA 301's predefined identifiers end in the node id),
///     set-points and SDO requests included: a second master that commands our drives must be seen,
///   - NMT and SYNC, which our nodes obey whoever sends them,
///   - boot-up and heartbeat of any node: so a device that robot.yaml does not list, or lists with another
///     id, is noticed,
///   - SDO answers of the bridge's own node id: so a drive that has it, as some are delivered, is noticed.
/// Process data of foreign nodes stays out.
std::vector<CanFilter> bus_filters(const RobotConfig& robot, int bus);

}  // namespace sprung
