#include "tools/lab/gait/push_experiment.h"

#include <algorithm>
#include <cmath>

#include "planner/gait/body_frame.h"
#include "planner/gait/capture_point.h"
#include "tools/lab/gait/walking_robot.h"

namespace sprung {
namespace {

constexpr double kPush_s = 0.1;
constexpr double kSettlePushed_s = 3.0, kRecover_s = 2.5;
constexpr PushDirection kDirections[] = {PushDirection::kLeft, PushDirection::kRight, PushDirection::kForward,
                                         PushDirection::kBackward};

bool is_sideways(PushDirection direction) noexcept {
  return direction == PushDirection::kLeft || direction == PushDirection::kRight;
}

/// Until the gait's clock passes this share of its period; at most two periods.
void wait_for_phase(WalkingRobot& walker, const RobotConfig& robot, const PushCase& config, double phase) {
  if (config.phases < 2) return;
  const double period_s = robot.gaits[gait_index(robot, config.gait)].period_s;
  const double near = robot.cycle_s / period_s;
  const auto most_cycles = static_cast<int>(std::ceil(2.0 * period_s / robot.cycle_s));
  for (int cycle = 0; cycle < most_cycles; ++cycle) {
    if (std::abs(std::remainder(walker.robot().motion_state().gait_phase - phase, 1.0)) <= near) return;
    walker.run(robot.cycle_s);
  }
}

}  // namespace

std::array<double, 2> impulse_vector_Ns(PushDirection direction, double impulse_Ns) noexcept {
  switch (direction) {
    case PushDirection::kLeft:
      return {0.0, impulse_Ns};
    case PushDirection::kRight:
      return {0.0, -impulse_Ns};
    case PushDirection::kForward:
      return {impulse_Ns, 0.0};
    case PushDirection::kBackward:
      break;
  }
  return {-impulse_Ns, 0.0};
}

std::vector<PushCase> push_cases() {
  const std::vector<double> standing{10, 15, 20, 25, 30, 35, 40, 45, 50, 60, 80};
  return {{"held", "", 0.0, 1, standing, 0.0},
          {"stand", "stand", 0.0, 1, standing, 30.0},
          {"trot", "trot", 0.3, 8, {5, 10, 15, 20, 25, 30, 40, 60}, 15.0}};
}

PushOutcome push_once(const RobotConfig& robot, const PushTask& task, const PushCase& config,
                      double impulse_Ns, PushDirection direction) {
  WalkingRobot walker(robot, task.preset, lying(task.sim));
  if (!config.gait.empty()) walker.walk(config.gait, {config.speed_m_s, 0.0, 0.0});
  walker.run(kSettlePushed_s);
  const BodyShape shape(robot);
  PushOutcome out;
  out.name = config.name;
  out.impulse_Ns = impulse_Ns;
  out.direction = direction;
  for (int i = 0; i < config.phases && walker.upright(); ++i) {
    wait_for_phase(walker, robot, config, static_cast<double>(i) / config.phases);
    walker.push(impulse_vector_Ns(direction, impulse_Ns), kPush_s);
    walker.run(kRecover_s, [&](InProcessRobot& r) {
      const Attitude tilt = attitude(r.truth().base_quaternion_wxyz);
      out.tilt_most_rad = std::max({out.tilt_most_rad, std::abs(tilt.roll_rad), std::abs(tilt.pitch_rad)});
      out.capture_beyond = std::fmax(out.capture_beyond, capture_beyond(r.joint_state(), shape));
    });
    if (walker.upright()) ++out.survived;
  }
  out.vitals = walker.vitals();
  out.reserve = walker.reserve().least;
  out.simulated_s = walker.simulated_s();
  return out;
}

std::vector<PushOutcome> run_push(const RobotConfig& robot, const PushTask& task,
                                  const std::vector<PushCase>& cases) {
  struct One {
    const PushCase* config;
    double impulse_Ns;
    PushDirection direction;
  };
  std::vector<One> all;
  for (const PushCase& config : cases)
    for (const double impulse_Ns : config.impulses_Ns)
      for (const PushDirection direction : kDirections) all.push_back({&config, impulse_Ns, direction});
  return parallel_map(
      all.size(),
      [&](std::size_t i) {
        return push_once(robot, task, *all[i].config, all[i].impulse_Ns, all[i].direction);
      },
      task.parallel);
}

double survived_impulse_Ns(const PushCase& config, const std::vector<PushOutcome>& outcomes, bool sideways) {
  double least_Ns = INFINITY;  // that threw it over
  for (const PushOutcome& o : outcomes)
    if (o.name == config.name && is_sideways(o.direction) == sideways && !o.stayed_up())
      least_Ns = std::min(least_Ns, o.impulse_Ns);
  double most_Ns = 0.0;
  for (const double impulse_Ns : config.impulses_Ns)
    if (impulse_Ns < least_Ns) most_Ns = std::max(most_Ns, impulse_Ns);
  return most_Ns;
}

std::vector<ReportRow> push_rows(const std::vector<PushCase>& cases,
                                 const std::vector<PushOutcome>& outcomes) {
  std::vector<ReportRow> rows;
  for (const PushCase& c : cases) {
    rows.push_back(row("push." + c.name + ".survived_impulse", "N s", survived_impulse_Ns(c, outcomes, true),
                       demanded(c.demanded_Ns > 0.0, at_least(c.demanded_Ns))));
    rows.push_back(
        row("push." + c.name + ".survived_foreaft", "N s", survived_impulse_Ns(c, outcomes, false)));
    int uncaught = 0, trips = 0;
    double reserve = kNaN, beyond = kNaN;
    for (const PushOutcome& o : outcomes) {
      if (o.name != c.name) continue;
      if (o.stayed_up()) reserve = std::fmin(reserve, o.reserve);
      if (o.stayed_up()) beyond = std::fmax(beyond, o.capture_beyond);
      uncaught += o.vitals.fell && !o.vitals.caught ? 1 : 0;
      trips += o.vitals.trips;
    }
    rows.push_back(row("push." + c.name + ".uncaught_falls", "", uncaught, at_most(0.0)));
    rows.push_back(row("push." + c.name + ".trips", "", trips, at_most(0.0)));
    if (std::isfinite(beyond)) rows.push_back(row("push." + c.name + ".capture_beyond", "", beyond));
    if (std::isfinite(reserve))
      rows.push_back(row("push." + c.name + ".voltage_reserve", "%", 100.0 * reserve));
  }
  return rows;
}

report::Section push_section(const std::vector<PushOutcome>& outcomes) {
  report::Section out{"Each impulse and direction"};
  report::Table table{
      "Over 0.1 s, at the trunk's centre",
      {"stance", "impulse (N s)", "direction", "pushes survived", "most tilt (rad)", "what became of it"}};
  for (const PushOutcome& o : outcomes)
    table.rows.push_back({o.name, o.impulse_Ns, name(o.direction), o.survived, o.tilt_most_rad,
                          o.stayed_up() ? report::Cell{"stays up", report::Mark::kGood}
                                        : report::Cell{o.vitals.why, report::Mark::kBad}});
  table.note = "Pushes follow one another on the same robot, each at another phase of the gait.";
  out.tables = {table};
  return out;
}

Experiment push_experiment() {
  Experiment out = gait_experiment(
      "push",
      "Impulses at the trunk's centre in four directions: stance held in position control, on springs, "
      "trotting.",
      "How hard a push does the robot survive, at every phase of its gait, and is a fall caught?");
  out.run = [](const ExperimentInput& in) {
    const std::vector<PushCase> cases = push_cases();
    const std::vector<PushOutcome> outcomes = run_push(in.robot, {in.preset, in.sim, in.parallel}, cases);
    ExperimentOutput output{push_rows(cases, outcomes), 0.0, {push_section(outcomes)}};
    for (const PushOutcome& o : outcomes) output.simulated_s += o.simulated_s;
    return output;
  };
  return out;
}

}  // namespace sprung
