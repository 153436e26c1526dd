#include "tools/lab/gait/endurance.h"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "robots/gait_speed.h"
#include "simulation/plant/plant_words.h"
#include "tools/lab/bench/stopwatch.h"
#include "tools/lab/gait/endurance_world.h"
#include "tools/lab/gait/walking_robot.h"
#include "tools/lab/run/dice.h"

namespace sprung {

namespace {

constexpr double kShortestCommand_s = 3.0, kLongestCommand_s = 12.0;
constexpr double kStopping_s = 12.0;  // the slowest gait's last round, and the way to its places
constexpr double kFrictionSpread = 0.20, kMassSpread = 0.10;
constexpr double kSlippery = 0.4, kGrippy = 1.0;
constexpr double kLowest = 0.9, kHighest = 1.02;  // of the preset's height
constexpr double kWider_m = 0.04;
constexpr int kOneStopsIn = 8;

int endurance_gait(const RobotConfig& robot, const std::string& gait) {
  for (std::size_t i = 0; i < robot.gaits.size(); ++i)
    if (robot.gaits[i].name == gait) return static_cast<int>(i);
  return -1;
}

/// From standing any gait; in a gait itself or what may follow it.
int next_gait(const RobotConfig& robot, int now, Dice& dice) {
  if (now < 0) return static_cast<int>(dice.below(robot.gaits.size()));
  const std::vector<std::string>& to = robot.gaits[now].to;
  const std::size_t choice = dice.below(to.size() + 1);
  return choice == to.size() ? now : endurance_gait(robot, to[choice]);
}

EnduranceStep walk(const RobotConfig& robot, const std::string& preset, int gait, Dice& dice) {
  const GaitConfig& g = robot.gaits[gait];
  const PresetConfig& p = robot.preset(preset);
  EnduranceStep out;
  out.command.kind = OperatorKind::kWalk;
  out.command.gait = gait;
  out.command.walk_speed = {dice.between(-g.fastest_backward_m_s, g.fastest_forward_m_s),
                            dice.between(-g.fastest_sideways_m_s, g.fastest_sideways_m_s),
                            dice.between(-g.fastest_turning_rad_s, g.fastest_turning_rad_s)};
  // Together they are at most what the gait goes: what is beyond is drawn in to the edge.
  const double share = std::max(1.0, speed_share(g, out.command.walk_speed));
  for (double& speed : out.command.walk_speed) speed /= share;
  out.command.body_height_m = p.stand_length_m * dice.between(kLowest, kHighest);
  out.command.stance_width_m = p.walk.stance_width_m + dice.between(0.0, kWider_m);
  // Another gait begins when all feet stand: it has its round before the next request.
  out.lasts_s = std::max(dice.between(kShortestCommand_s, kLongestCommand_s), 2.0 * g.period_s);
  return out;
}

EnduranceStep stop() {
  EnduranceStep out;
  out.command.kind = OperatorKind::kStop;
  out.lasts_s = kStopping_s;
  return out;
}

}  // namespace

std::vector<EnduranceStep> endurance_script(const RobotConfig& robot, const std::string& preset,
                                            std::uint64_t seed, double duration_s) {
  Dice dice(seed);
  std::vector<EnduranceStep> out;
  int gait = -1;
  double left_s = duration_s;
  while (left_s > 0.0) {
    if (gait >= 0 && dice.below(kOneStopsIn) == 0) {
      out.push_back(stop());
      gait = -1;
    } else {
      gait = next_gait(robot, gait, dice);
      out.push_back(walk(robot, preset, gait, dice));
    }
    out.back().lasts_s = std::min(out.back().lasts_s, left_s);
    left_s -= out.back().lasts_s;
  }
  return out;
}

std::map<std::string, double> endurance_plant(std::uint64_t number) {
  Dice dice(~number);  // not the script's
  std::map<std::string, double> plant;
  plant["friction_scale"] = dice.between(1.0 - kFrictionSpread, 1.0 + kFrictionSpread);
  plant["mass_scale"] = dice.between(1.0 - kMassSpread, 1.0 + kMassSpread);
  plant["ground_friction"] = dice.between(kSlippery, kGrippy);
  return plant;
}

namespace {

constexpr double kSecond_s = 1.0;  // commands take effect within a cycle: a fall is seen in time
constexpr double kAfterwards_s = 1.0;
constexpr std::uint64_t kMostSeeds = 1000;  // so that ensembles have no plant in common

std::string words(const RobotConfig& robot, const OperatorCommand& command) {
  if (command.kind == OperatorKind::kStop) return "stop";
  char text[120];
  std::snprintf(text, sizeof text, "%s %.2f %.2f m/s %.2f rad/s, height %.3f m, width %.3f m",
                robot.gaits[command.gait].name.c_str(), command.walk_speed[0], command.walk_speed[1],
                command.walk_speed[2], command.body_height_m, command.stance_width_m);
  return text;
}

/// @return false when the robot has fallen or tripped.
bool obey(WalkingRobot& walker, const EnduranceStep& step) {
  walker.say(step.command);
  double left_s = step.lasts_s;
  while (left_s > 0.0) {
    walker.run(std::min(left_s, kSecond_s));
    if (!walker.upright()) return false;
    left_s -= kSecond_s;
  }
  return true;
}

}  // namespace

EnduranceOutcome endure(const RobotConfig& robot, const EnduranceRequest& request, std::size_t place) {
  const double began_s = processor_s();
  const std::uint64_t seed = request.seed + place;
  const std::uint64_t number = kMostSeeds * (request.ensemble - 1) + place + 1;
  SimOptions sim{seed, endurance_plant(number)};
  if (request.worlds) sim.plant.merge(endurance_world(robot, number));
  for (const auto& [key, value] : request.plant) sim.plant[key] = value;
  EnduranceOutcome out;
  out.seed = seed;
  out.plant = sim.plant;
  WalkingRobot walker(robot, request.preset, lying(sim));
  for (const EnduranceStep& step : endurance_script(robot, request.preset, seed, 60.0 * request.minutes)) {
    ++out.requests;
    if (obey(walker, step)) continue;
    out.doing = words(robot, step.command);
    walker.run(kAfterwards_s);
    break;
  }
  out.vitals = walker.vitals();
  out.reserve = walker.reserve();
  out.refusals = walker.refusals();
  out.simulated_s = walker.simulated_s();
  out.processor_s = processor_s() - began_s;
  return out;
}

std::vector<EnduranceOutcome> run_endurance(const RobotConfig& robot, const EnduranceRequest& request) {
  if (request.seeds < 1 || request.seeds > static_cast<int>(kMostSeeds))
    throw std::invalid_argument("--seeds must be 1 to " + std::to_string(kMostSeeds));
  if (request.ensemble < 1) throw std::invalid_argument("--ensemble must be 1 or more");
  if (!(request.minutes > 0.0)) throw std::invalid_argument("--minutes must be more than 0");
  return parallel_map(
      static_cast<std::size_t>(request.seeds), [&](std::size_t i) { return endure(robot, request, i); },
      request.parallel);
}

std::vector<ReportRow> endurance_rows(const std::vector<EnduranceOutcome>& outcomes, bool worlds) {
  const std::string name = worlds ? "endurance.worlds." : "endurance.all.";
  int falls = 0, uncaught = 0, trips = 0, refusals = 0, requests = 0;
  double watched_s = 0.0, saturated = 0.0, fastest_rad_s = 0.0, strongest_Nm = 0.0, reserve = kNaN;
  for (const EnduranceOutcome& o : outcomes) {
    falls += o.vitals.fell ? 1 : 0;
    uncaught += o.vitals.fell && !o.vitals.caught ? 1 : 0;
    trips += o.vitals.trips;
    refusals += o.refusals;
    requests += o.requests;
    watched_s += o.vitals.watched_s;
    saturated = std::max(saturated, o.vitals.saturated_share);
    fastest_rad_s = std::max(fastest_rad_s, o.vitals.fastest_rad_s);
    strongest_Nm = std::max(strongest_Nm, o.vitals.strongest_Nm);
    reserve = std::fmin(reserve, o.reserve.least);
  }
  std::vector<ReportRow> rows = {row(name + "falls", "", falls, at_most(worlds ? 1.0 : 0.0)),
                                 row(name + "limit_trips", "", trips, at_most(0.0)),
                                 row(name + "uncaught_falls", "", uncaught, at_most(0.0)),
                                 row(name + "watched", "min", watched_s / 60.0),
                                 row(name + "requests", "", requests),
                                 row(name + "refusals", "", refusals),
                                 row(name + "saturated_worst", "%", 100.0 * saturated),
                                 row(name + "joint_speed_max", "rad/s", fastest_rad_s),
                                 row(name + "motor_torque_max", "Nm", strongest_Nm)};
  if (std::isfinite(reserve)) rows.push_back(row(name + "voltage_reserve", "%", 100.0 * reserve));
  return rows;
}

report::Section endurance_section(const std::vector<EnduranceOutcome>& outcomes) {
  report::Section out{"Each seed"};
  report::Table table{
      "",
      {"seed", "friction", "mass", "floor friction", "watched (s)", "requests", "saturated (%)",
       "joint speed (rad/s)", "motor torque (Nm)", "voltage reserve (%)", "plant", "what befell it"}};
  for (const EnduranceOutcome& o : outcomes) {
    const bool well = !o.vitals.fell && o.vitals.trips == 0;
    table.rows.push_back({o.seed, o.plant.at("friction_scale"), o.plant.at("mass_scale"),
                          o.plant.at("ground_friction"), o.vitals.watched_s, o.requests,
                          100.0 * o.vitals.saturated_share, o.vitals.fastest_rad_s, o.vitals.strongest_Nm,
                          100.0 * o.reserve.least, plant_text(o.plant),
                          well ? report::Cell{"nothing", report::Mark::kGood}
                               : report::Cell{o.vitals.why + " (" + o.doing + ")", report::Mark::kBad}});
  }
  table.note =
      "Drawn plants: friction and mass over sim.yaml's; a run ends when the robot falls or safety trips.";
  out.tables = {table};
  return out;
}

double endurance_speed(const std::vector<EnduranceOutcome>& outcomes) noexcept {
  double simulated_s = 0.0, used_s = 0.0;
  for (const EnduranceOutcome& o : outcomes) {
    simulated_s += o.simulated_s;
    used_s += o.processor_s;
  }
  return used_s > 0.0 ? simulated_s / used_s : kNaN;
}

Experiment endurance_experiment() {
  struct Own {
    int seeds = 20;
    double minutes = 10.0;
    std::uint64_t ensemble = 1;
    bool worlds = false;
  };
  const auto own = std::make_shared<Own>();
  Experiment out = gait_experiment(
      "endurance", "Minutes of an operator's commands at random on drawn plants.",
      "Does the robot stay up, and do its limits hold, whatever an operator asks of it?");
  out.seed_help = "of every noise and of the operator; 0 was used for tuning";
  out.own.option("--seeds", own->seeds, "how many, from --seed on, each on another plant");
  out.own.option("--ensemble", own->ensemble, "which plants are drawn about sim.yaml's");
  out.own.option("--minutes", own->minutes, "of commands for each");
  out.own.flag("--worlds", own->worlds, "on drawn slopes, hills and hollows, some with a payload");
  out.shorten = [own] { own->minutes = 1.0; };
  out.run = [own](const ExperimentInput& in) {
    const std::vector<EnduranceOutcome> outcomes = run_endurance(
        in.robot, {in.preset, in.sim.seed, own->seeds, own->minutes, in.sim.plant, in.parallel, own->ensemble,
                   own->worlds});
    ExperimentOutput output{endurance_rows(outcomes, own->worlds), 0.0, {endurance_section(outcomes)}};
    for (const EnduranceOutcome& o : outcomes) output.simulated_s += o.simulated_s;
    char text[80];
    std::snprintf(text, sizeof text, "whole stack in one process: %.1f x real time on one core",
                  endurance_speed(outcomes));
    output.remark = text;
    return output;
  };
  return out;
}

}  // namespace sprung
