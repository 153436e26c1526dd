#include "tools/lab/gait/endurance.h"

#include <time.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>

#include "tools/lab/gait/endurance_script.h"
#include "tools/lab/gait/walking_robot.h"

namespace sprung {
namespace {

constexpr double kSecond_s = 1.0;  // commands take effect within a cycle: a fall is seen in time
constexpr double kAfterwards_s = 1.0;

double processor_s() noexcept {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::string words(const RobotConfig& robot, const OperatorCommand& command) {
  if (command.kind == OperatorKind::kStop) return "stop";
  char text[120];
  std::snprintf(text, sizeof text, "%s %.2f %.2f m/s %.2f rad/s, height %.3f m, width %.3f m",
                robot.gaits[static_cast<std::size_t>(command.gait)].name.c_str(), command.walk_speed[0],
                command.walk_speed[1], command.walk_speed[2], command.body_height_m, command.stance_width_m);
  return text;
}

/// @return false when the robot has fallen or tripped.
bool obey(WalkingRobot& walker, const EnduranceStep& step) {
  walker.say(step.command);
  for (double left_s = step.lasts_s; left_s > 0.0; left_s -= kSecond_s) {
    walker.run(std::min(left_s, kSecond_s));
    if (!walker.upright()) return false;
  }
  return true;
}

ReportRow row(const char* quantity, const char* unit, double value) {
  return {std::string("endurance.all.") + quantity, unit, value, std::nullopt, std::nullopt, std::nullopt};
}

ReportRow none_of(const char* quantity, double value) {
  ReportRow out = row(quantity, "", value);
  out.high = 0.0;
  return out;
}

}  // namespace

EnduranceOutcome endure(const RobotConfig& robot, const EnduranceRequest& request, std::uint64_t seed) {
  const double began_s = processor_s();
  SimOptions sim = endurance_plant(seed);
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
  out.refusals = walker.refusals();
  out.simulated_s = walker.simulated_s();
  out.processor_s = processor_s() - began_s;
  return out;
}

std::vector<EnduranceOutcome> run_endurance(const RobotConfig& robot, const EnduranceRequest& request) {
  if (request.seeds < 1) throw std::invalid_argument("--seeds must be 1 or more");
  if (!(request.minutes > 0.0)) throw std::invalid_argument("--minutes must be more than 0");
  return parallel_map(
      static_cast<std::size_t>(request.seeds),
      [&](std::size_t i) { return endure(robot, request, request.seed + i); }, request.parallel);
}

std::vector<ReportRow> endurance_rows(const std::vector<EnduranceOutcome>& outcomes) {
  int falls = 0, uncaught = 0, trips = 0, refusals = 0, requests = 0;
  double watched_s = 0.0, saturated = 0.0, fastest_rad_s = 0.0, strongest_Nm = 0.0;
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
  }
  return {none_of("falls", falls),
          none_of("limit_trips", trips),
          none_of("uncaught_falls", uncaught),
          row("watched", "min", watched_s / 60.0),
          row("requests", "", requests),
          row("refusals", "", refusals),
          row("saturated_worst", "%", 100.0 * saturated),
          row("joint_speed_max", "rad/s", fastest_rad_s),
          row("motor_torque_max", "Nm", strongest_Nm)};
}

report::Section endurance_section(const std::vector<EnduranceOutcome>& outcomes) {
  report::Section out{"Each seed"};
  report::Table table{"",
                      {"seed", "friction", "mass", "floor friction", "watched (s)", "requests",
                       "saturated (%)", "joint speed (rad/s)", "motor torque (Nm)", "what befell it"}};
  for (const EnduranceOutcome& o : outcomes) {
    const bool well = !o.vitals.fell && o.vitals.trips == 0;
    table.rows.push_back({o.seed, o.plant.at("friction_scale"), o.plant.at("mass_scale"),
                          o.plant.at("ground_friction"), o.vitals.watched_s, o.requests,
                          100.0 * o.vitals.saturated_share, o.vitals.fastest_rad_s, o.vitals.strongest_Nm,
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

}  // namespace sprung
