#include "tools/lab/terrain/terrain_task.h"

#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "robots/config_error.h"
#include "signals/angles.h"
#include "simulation/plant/world.h"
#include "tools/lab/gait/drawn_payload.h"
#include "tools/lab/gait/walking_robot.h"
#include "tools/lab/terrain/payload_score.h"

namespace sprung {
namespace {

constexpr double kRadian = kPi / 180.0;
constexpr double kNoticed_s = 2.5;  // in which a fall is to be noticed
constexpr double kBegins_m = 0.8;   // ahead of where the trunk begins
using Plant = std::map<std::string, double>;

/// [D13] and two easier ones.
const std::vector<double>& slopes() {
  static const std::vector<double> levels{2.9, 5.7, 8.4, 11.0, 13.5, 16.1, 18.7, 21.3};
  return levels;
}

/// Level where the robot stands up.
Plant sloping(const char* key, double angle_deg) {
  return {{key, angle_deg * kRadian}, {"ground_begins", kBegins_m}};
}

Plant loaded(const RobotConfig& robot, double mass_kg, double draw) {
  Dice dice(static_cast<std::uint64_t>(draw));
  return drawn_payload(robot, mass_kg, dice);
}

/// Heights that robots/worlds have by themselves.
constexpr double kStairsRise_mm = 50.0, kRubble_mm = 30.0;

Plant in_world(const std::string& world, double scale) {
  return {{sim::kWorldKey + world, 1.0}, {"ground_scale", scale}};
}

void score_payload(const PayloadScore& score, const EstimatedPayload& stood, const EstimatedPayload& walked,
                   TerrainRun& run) {
  run.stood_mass_off_kg = score.mass_off_kg(stood);
  run.walked_mass_off_kg = score.mass_off_kg(walked);
  run.stood_com_off_m = score.com_off_m(stood);
  run.walked_com_off_m = score.com_off_m(walked);
}

std::string failure_of(const TerrainRun& run, const MotionState& motion) {
  const bool tripped_first = run.vitals.why.rfind("fell", 0) != 0;
  if (run.vitals.trips > 0 && tripped_first) return "tripped: " + run.vitals.why;
  if (run.vitals.fell && !run.vitals.caught) return "fell, and the planner did not notice";
  if (run.vitals.fell) return run.vitals.why;
  if (motion.state != MotionPhase::kWalking) return std::string("stopped: ") + motion.last_transition;
  if (!(run.went_m_s >= kLeastSpeedShare * run.speed_m_s))
    return "slow: " + std::to_string(std::lround(1e3 * run.went_m_s)) + " mm/s";
  return {};
}

}  // namespace

const std::vector<TerrainTask>& terrain_tasks() {
  static const std::vector<TerrainTask> tasks{
      {"slope_up", "a ramp, up", "deg", slopes(),
       [](const RobotConfig&, double v, double) { return sloping("slope", v); }},
      {"slope_down", "a ramp, down", "deg", slopes(),
       [](const RobotConfig&, double v, double) { return sloping("slope", -v); }},
      {"slope_across", "a slope that falls to the right", "deg", slopes(),
       [](const RobotConfig&, double v, double) { return sloping("side_slope", v); }},
      {"wave",
       "hills and hollows, 1 m from hill to hill; amplitude",
       "mm",
       {10, 20, 30, 40, 50, 60, 80},
       [](const RobotConfig&, double v, double) {
         return Plant{{"wave", 1e-3 * v}, {"ground_begins", kBegins_m}};
       }},
      {"friction",
       "a level floor of little friction",
       "",
       {0.8, 0.6, 0.5, 0.4, 0.35, 0.3, 0.25, 0.2, 0.15},
       [](const RobotConfig&, double v, double) {
         return Plant{{"ground_friction", v}};
       }},
      {"stairs",
       "stairs with treads of 30 cm, up and, beyond 4 m, down again; rise",
       "mm",
       {20, 30, 40, 50, 60, 80, 110},
       [](const RobotConfig&, double v, double) { return in_world("stairs", v / kStairsRise_mm); }},
      {"rough",
       "a rough floor with boards and kerbs; the tallest",
       "mm",
       {10, 20, 30, 40, 50, 60, 80},
       [](const RobotConfig&, double v, double) { return in_world("rubble", v / kRubble_mm); }},
      {"patch",
       "slippery patches on a dry floor; their friction",
       "",
       {0.4, 0.3, 0.25, 0.2, 0.15, 0.1, 0.05},
       [](const RobotConfig&, double v, double) {
         Plant out = in_world("ice", 1.0);
         out["patch_friction"] = v;
         return out;
       }},
      {"payload",
       "a weight that nobody told it of, anywhere on its back",
       "kg",
       {1, 2, 3, 4, 5, 6, 8, 10, 12},
       loaded},
  };
  return tasks;
}

TerrainRun walk_terrain(const RobotConfig& robot, const std::string& preset, const SimOptions& plant,
                        const TerrainTask& task, double level, TerrainRun run) {
  SimOptions sim = lying(plant);
  const auto draw = sim.plant.find("draw");
  if (draw != sim.plant.end()) run.draw = draw->second;
  for (const auto& [key, value] : task.plant(robot, level, run.draw)) sim.plant[key] = value;
  try {
    WalkingRobot walker(robot, preset, sim);
    const EstimatedPayload stood = walker.robot().motion_state().payload;
    PayloadScore score(robot);
    const Vec3 speed{run.speed_m_s, 0.0, 0.0};
    walker.walk(run.gait, speed);
    walker.run(speed_reached_s(robot, preset, run.gait, speed));
    const double from_m = walker.robot().truth().com_in_world_m[0];
    const double lasts_s = run.distance_m / run.speed_m_s;
    double time_s = 0.0;
    for (; time_s < lasts_s && walker.upright(); time_s += 0.5)
      walker.run(0.5, [&score](InProcessRobot& r) { score.add(r); });
    run.went_m_s = (walker.robot().truth().com_in_world_m[0] - from_m) / time_s;
    if (!walker.upright()) walker.run(kNoticed_s);
    run.vitals = walker.vitals();
    run.simulated_s = walker.simulated_s();
    run.why = failure_of(run, walker.robot().motion_state());
    if (run.passed()) score_payload(score, stood, walker.robot().motion_state().payload, run);
  } catch (const ConfigError&) {
    throw;
  } catch (const std::runtime_error& error) {
    run.why = error.what();
  }
  return run;
}

TerrainTask world_task(const std::string& world) {
  return {std::filesystem::path(world).stem().string(),
          "the world " + world + "; its heights and slopes against those that it has by itself",
          "x",
          {0.25, 0.5, 0.75, 1.0, 1.25, 1.5, 2.0},
          [world](const RobotConfig&, double v, double) { return in_world(world, v); },
          {},
          world};
}

int hardest_level(int levels, const std::function<bool(int level)>& passes) {
  int passed = -1, failed = levels;
  while (failed - passed > 1) {
    const int middle = (passed + failed) / 2;
    (passes(middle) ? passed : failed) = middle;
  }
  return passed;
}

}  // namespace sprung
