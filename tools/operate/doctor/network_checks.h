#pragma once
/// LCM's network: route, loop-back, ttl, buffers. Pure.
#include <vector>

#include "robots/robot_config.h"
#include "tools/operate/doctor/check.h"
#include "tools/operate/doctor/machine_facts.h"

namespace sprung::doctor {

/// @param robot of which the processes' hosts count; nullptr = none.
std::vector<Check> network_checks(const KernelFacts& kernel, const LoopbackFacts& loopback,
                                  const RobotConfig* robot);

}  // namespace sprung::doctor
