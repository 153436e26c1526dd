#include "tools/lab/terrain/terrain_levels.h"

#include <algorithm>
#include <filesystem>

#include "robots/yaml_reader.h"

namespace sprung {
namespace {

constexpr double kMostLevel = 1e4;

bool one_way(const std::vector<double>& levels) {
  const auto rises = [](double a, double b) { return a >= b; };
  const auto falls = [](double a, double b) { return a <= b; };
  return std::adjacent_find(levels.begin(), levels.end(), rises) == levels.end() ||
         std::adjacent_find(levels.begin(), levels.end(), falls) == levels.end();
}

void read_wanted(const RobotConfig& robot, const YamlMap& map, TerrainTask& task) {
  const YamlMap wanted = map.map("wanted");
  for (const GaitConfig& gait : robot.gaits) {
    if (!wanted.has(gait.name)) continue;
    const double level = wanted.quantity(gait.name, task.unit, 0.0, kMostLevel);
    if (std::find(task.levels.begin(), task.levels.end(), level) == task.levels.end())
      wanted.fail(gait.name, "is none of this task's levels");
    task.wanted[gait.name] = level;
  }
  wanted.finish();
}

void read_task(const RobotConfig& robot, const YamlMap& map, TerrainTask& task) {
  if (map.has("levels")) task.levels = map.quantities("levels", task.unit, 0.0, kMostLevel);
  if (task.levels.empty()) map.fail("levels", "expected one or more, from easy to hard");
  if (!one_way(task.levels)) map.fail("levels", "expected from easy to hard, each once: all up, or all down");
  if (map.has("wanted")) read_wanted(robot, map, task);
  map.finish();
}

}  // namespace

std::vector<TerrainTask> terrain_tasks_of(const RobotConfig& robot) {
  std::vector<TerrainTask> out = terrain_tasks();
  const std::string path = robot.folder + "/terrain.yaml";
  if (!std::filesystem::exists(path)) return out;
  const YamlMap file = YamlMap::load(path);
  if (file.text("robot") != robot.name)
    file.fail("robot", "expected " + robot.name + ", as in robot.yaml beside it");
  const YamlMap tasks = file.map("tasks");
  for (TerrainTask& task : out)
    if (tasks.has(task.name)) read_task(robot, tasks.map(task.name), task);
  tasks.finish();
  file.finish();
  return out;
}

}  // namespace sprung
