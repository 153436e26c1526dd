#pragma once
/// Object dictionary of a simulated Elmo Gold drive: gold.eds, and what a real drive has from its
/// commissioning.
#include <cstdint>

#include "simulation/node/object_dictionary.h"

namespace sprung::sim {

/// Values that a real drive has from its commissioning.
struct GoldCommissioning {
  int node = 1;
  std::uint32_t revision = 0;
  std::uint32_t serial = 1;
  std::uint32_t rated_current_mA = 0;
  std::uint32_t rated_torque_mNm = 0;     ///< motor side
  std::uint32_t max_motor_speed_rpm = 0;  ///< 0x6080
  std::uint32_t supply_mV = 0;
};

ObjectDictionary gold_dictionary(const GoldCommissioning& commissioning);

/// Objects that canopen/objects.h does not name, since the bridge has no use for them.
inline constexpr std::uint16_t kTorqueDemand = 0x6074;    ///< per mille of rated torque
inline constexpr std::uint16_t kVelocityActual = 0x606C;  ///< counts/s
inline constexpr std::uint16_t kFollowingError = 0x60F4;  ///< counts

}  // namespace sprung::sim
