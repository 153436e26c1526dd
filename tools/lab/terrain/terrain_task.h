#pragma once
/// What robots are tried on, each in levels of growing difficulty; one run of one; and the hardest that is
/// passed. Pure but for the simulation.
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "simulation/sim_core.h"
#include "tools/lab/gait/walk_vitals.h"

namespace sprung {

struct TerrainTask {
  std::string name;            ///< of rows, and of --only but for a world's
  std::string what;            ///< for people
  std::string unit;            ///< of its levels
  std::vector<double> levels;  ///< ascending in difficulty; a robot may have its own: terrain_levels.h
  /// Keys of `--plant` that make this level, on this draw of variation.yaml.
  std::function<std::map<std::string, double>(const RobotConfig& robot, double level, double draw)> plant;
  std::map<std::string, double> wanted{};  ///< level that a gait is to pass, by its name
  std::string world{};                     ///< as it was typed; empty: it is one of terrain_tasks()
};

const std::vector<TerrainTask>& terrain_tasks();
/// Of a world alone (simulation/plant/world.h): levels are shares of its heights, named after its file.
TerrainTask world_task(const std::string& world);

struct TerrainRun {
  double draw = 0.0;  ///< of variation.yaml; 0: the nominal plant
  std::string gait;
  double speed_m_s = 0.0;   ///< asked for
  double distance_m = 0.0;  ///< asked for
  double went_m_s = 0.0;    ///< true mean, along world x, which it starts along
  WalkVitals vitals;
  std::string why;   ///< it did not pass; empty: it did
  std::string page;  ///< that plays it, beside the experiment's; empty: none
  double simulated_s = 0.0;
  /// Of what the robot says that it carries: after it stood up, and when it had walked.
  double stood_mass_off_kg = kNaN, walked_mass_off_kg = kNaN;
  double stood_com_off_m = kNaN, walked_com_off_m = kNaN;

  bool passed() const noexcept { return why.empty(); }
};

/// Stands up, walks along world x, and must not fall, trip, stop, or go slower than kLeastSpeedShare. Nobody
/// pushes. A plant that fails, and a robot that does not stand up, are failures of the run.
/// @param plant without its ground. @param run what is asked for; what became of it is returned in it.
/// @throws ConfigError for a plant that there is not, std::invalid_argument for a gait that there is not.
TerrainRun walk_terrain(const RobotConfig& robot, const std::string& preset, const SimOptions& plant,
                        const TerrainTask& task, double level, TerrainRun run);

/// [design choice] Of the speed asked for: less is not walking there.
constexpr double kLeastSpeedShare = 0.7;

/// Index of the hardest level that `passes`, by binary search; -1: not even the first.
int hardest_level(int levels, const std::function<bool(int level)>& passes);

}  // namespace sprung
