#pragma once
/// What robot.yaml and the profile want of a node, as a list to compare with what the node says: identity,
/// settings and PDOs, the same that the bridge verifies and writes when it boots. Pure; allocates.
#include <string>
#include <vector>

#include "tools/can/decode/bus_description.h"

namespace sprung::cantools {

struct ExpectedObject {
  canopen::ObjectId object;
  int size = 0;  ///< bytes
  std::uint32_t value = 0;
  bool is_signed = false;
  std::uint32_t mask = 0xFFFFFFFF;  ///< bits that count: of a PDO that shall be off only that it is
};

/// Identity, settings, PDOs: what the bridge verifies and writes, each object once with the value that it
/// ends with.
std::vector<ExpectedObject> expected_objects(const NodeDescription& node, const DriveTiming& timing);

/// Whether the node's number is what was expected. A transmit PDO's bit 30 (RTR not allowed) may differ:
/// nobody asks for PDOs.
bool matches(const ExpectedObject& expected, std::uint32_t found) noexcept;

}  // namespace sprung::cantools
