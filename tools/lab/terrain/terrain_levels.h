#pragma once
/// Levels of terrain tasks as a robot's own terrain.yaml has them, beside its robot.yaml: what is hard
/// depends on how long its legs are.
#include <vector>

#include "tools/lab/terrain/terrain_task.h"

namespace sprung {

/// terrain_tasks() with the robot's own levels where it names them, and what each gait is to pass; as they
/// are without the file.
/// @throws ConfigError naming file, line and remedy: a task or gait that there is not, levels that do not all
/// go one way, or something wanted that is no level.
std::vector<TerrainTask> terrain_tasks_of(const RobotConfig& robot);

}  // namespace sprung
