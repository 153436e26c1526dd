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

/// "ttl=0" of an LCM url; LCM's own default is 0.
int ttl_of(const std::string& lcm_url);
/// "recv_buf_size=..." of an LCM url; 0 = not asked for.
std::int64_t receive_buffer_of(const std::string& lcm_url);

}  // namespace sprung::doctor
