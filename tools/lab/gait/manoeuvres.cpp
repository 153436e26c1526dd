#include "tools/lab/gait/manoeuvres.h"

#include <cmath>

#include "tools/lab/gait/walking_robot.h"

namespace sprung {
namespace {

constexpr double kPeriods = 3.0;
constexpr const char* kManoeuvreDirections[] = {"forward", "backward", "sideways", "turning", "curve"};

Vec3 fastest(const GaitConfig& gait, std::size_t direction) {
  const double each = 1.0 / std::sqrt(3.0);
  switch (direction) {
    case 0:
      return {gait.fastest_forward_m_s, 0.0, 0.0};
    case 1:
      return {-gait.fastest_backward_m_s, 0.0, 0.0};
    case 2:
      return {0.0, gait.fastest_sideways_m_s, 0.0};
    case 3:
      return {0.0, 0.0, gait.fastest_turning_rad_s};
    default:
      return {each * gait.fastest_forward_m_s, each * gait.fastest_sideways_m_s,
              each * gait.fastest_turning_rad_s};
  }
}

}  // namespace

std::vector<Manoeuvre> manoeuvres(const RobotConfig& robot) {
  std::vector<Manoeuvre> out;
  for (const GaitConfig& gait : robot.gaits) {
    if (!(gait.fastest_forward_m_s > 0.0)) continue;
    for (std::size_t i = 0; i < std::size(kManoeuvreDirections); ++i)
      out.push_back({gait.name, kManoeuvreDirections[i], fastest(gait, i)});
  }
  return out;
}

ManoeuvreOutcome manoeuvre(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                           const Manoeuvre& what) {
  WalkingRobot walker(robot, preset, lying(sim));
  walker.walk(what.gait, what.speed);
  walker.run(speed_reached_s(robot, preset, what.gait, what.speed) +
             kPeriods * robot.gaits[gait_index(robot, what.gait)].period_s);
  return {what, walker.vitals(), walker.reserve(), walker.simulated_s()};
}

std::vector<ReportRow> manoeuvre_rows(const std::vector<ManoeuvreOutcome>& outcomes) {
  std::vector<ReportRow> rows;
  for (const ManoeuvreOutcome& o : outcomes) {
    const std::string name = "walk." + o.what.gait + "." + o.what.direction;
    const bool stays_up = !o.vitals.fell && o.vitals.trips == 0;
    rows.push_back(row(name + ".stays_up", "", stays_up ? 1.0 : 0.0, at_least(1.0)));
    if (std::isfinite(o.reserve.least))
      rows.push_back(row(name + ".voltage_reserve", "%", 100.0 * o.reserve.least,
                         at_least(100.0 * VoltageReserve::kWanted)));
  }
  return rows;
}

report::Section manoeuvre_section(const std::vector<ManoeuvreOutcome>& outcomes) {
  report::Section out{"Other directions, at the gait's fastest"};
  report::Table table{"Until the speed is reached and three periods more",
                      {"gait", "direction", "forward (m/s)", "left (m/s)", "turning (rad/s)",
                       "voltage reserve, least (%)", "of", "what befell it"}};
  for (const ManoeuvreOutcome& o : outcomes)
    table.rows.push_back({o.what.gait, o.what.direction, o.what.speed[0], o.what.speed[1], o.what.speed[2],
                          100.0 * o.reserve.least, o.reserve.actuator,
                          o.vitals.why.empty() ? "nothing" : o.vitals.why});
  out.tables = {table};
  return out;
}

}  // namespace sprung
