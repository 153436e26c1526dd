#pragma once
/// Every simulated device that was built in: one for each folder of drivers/profiles
/// (cmake/SprungProfiles.cmake finds them).
#include <memory>
#include <string>
#include <vector>

#include "simulation/node/sim_device.h"

namespace sprung::sim {

/// What a profile's folder offers to the simulation; the maker that does not apply is nullptr.
struct DeviceKind {
  const char* name;  ///< of the folder, as robot.yaml's `profile`
  std::unique_ptr<SimDrive> (*make_drive)(const SimDriveSetup& setup);
  std::unique_ptr<SimCard> (*make_card)(const SimCardSetup& setup);
};

/// In the order of the folders' names.
const std::vector<const DeviceKind*>& device_kinds();

/// @throws ConfigError naming the profiles there are.
std::unique_ptr<SimDrive> make_sim_drive(const SimDriveSetup& setup);
std::unique_ptr<SimCard> make_sim_card(const SimCardSetup& setup);

}  // namespace sprung::sim
