#pragma once
/// Buses, programs, disk. Pure.
#include <vector>

#include "robots/robot_config.h"
#include "tools/operate/doctor/check.h"
#include "tools/operate/doctor/machine_facts.h"

namespace sprung::doctor {

/// One for each bus. @param robot whose bit rate and nodes count.
std::vector<Check> can_checks(const std::vector<BusFacts>& buses, const RobotConfig& robot);

std::vector<Check> software_checks(const SoftwareFacts& software);

Check disk_check(const DiskFacts& disk);

/// Whether an LCM version is one that sprung is tested with: 1.3.1 and later.
bool known_lcm(const std::string& version);

}  // namespace sprung::doctor
