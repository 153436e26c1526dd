#include "simulation/device_registry.h"

#include "robots/robot_loader.h"

namespace sprung::sim {
namespace {

const DeviceKind* find(const std::string& name) {
  for (const DeviceKind* kind : device_kinds()) {
    if (kind->name == name) return kind;
  }
  return nullptr;
}

[[noreturn]] void refuse(const std::string& what, const std::string& profile) {
  std::string known;
  for (const DeviceKind* kind : device_kinds())
    known += (known.empty() ? "" : ", ") + std::string(kind->name);
  throw ConfigError(what + ": no simulated device for profile '" + profile +
                    "' of this kind; there are: " + known);
}

}  // namespace

std::unique_ptr<SimDrive> make_sim_drive(const SimDriveSetup& setup) {
  const DeviceKind* kind = find(setup.actuator.profile);
  if (kind == nullptr || kind->make_drive == nullptr) refuse(setup.actuator.name, setup.actuator.profile);
  return kind->make_drive(setup);
}

std::unique_ptr<SimCard> make_sim_card(const SimCardSetup& setup) {
  const DeviceKind* kind = find(setup.card.profile);
  if (kind == nullptr || kind->make_card == nullptr) refuse(setup.card.name, setup.card.profile);
  return kind->make_card(setup);
}

}  // namespace sprung::sim
