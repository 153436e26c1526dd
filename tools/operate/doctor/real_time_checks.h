#pragma once
/// What a control loop needs of the kernel: priority, memory, CPUs, clock. Pure.
#include <vector>

#include "robots/robot_config.h"
#include "tools/operate/doctor/check.h"
#include "tools/operate/doctor/machine_facts.h"

namespace sprung::doctor {

/// UTC of this machine as NTP or PTP has it.
struct UtcFacts {
  bool synchronised = false;
  double error_ms = 0.0;  ///< the kernel's estimate of its largest error
};

/// @param robot whose processes want priorities and CPUs; nullptr = none.
std::vector<Check> real_time_checks(const KernelFacts& kernel, const LimitFacts& limits, const UtcFacts& utc,
                                    const RobotConfig* robot);

}  // namespace sprung::doctor
