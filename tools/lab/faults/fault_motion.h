#pragma once
/// What a robot does when a fault strikes it.
#include <functional>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "simulation/in_process/inprocess_robot.h"

namespace sprung {

/// "standing", "comply", each gait that steps, and the phases of a jump where the robot jumps: "crouch",
/// "thrust", "flight", "landing".
std::vector<std::string> fault_motions(const RobotConfig& robot);
inline constexpr const char* kNoMotion = "standing";

/// From a stand into the motion: a walk for two seconds and a part of a step that the seed draws, comply for
/// one, a jump up to this phase.
/// @param tick makes a cycle in place of robot.tick(), for who watches each.
/// @throws std::invalid_argument with those that there are; std::runtime_error where it does not begin.
void begin_motion(InProcessRobot& robot, const RobotConfig& config, const std::string& motion,
                  std::uint64_t seed, const std::function<void()>& tick = {});

}  // namespace sprung
