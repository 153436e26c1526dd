#include "tools/lab/gait/fall_experiment.h"

#include <algorithm>
#include <cmath>

#include "planner/gait/body_view.h"
#include "tools/common/parallel.h"
#include "tools/lab/gait/walking_robot.h"

namespace sprung {
namespace {

constexpr double kPushOver_s = 0.1, kSettleBefore_s = 3.0, kWatched_s = 3.0;
constexpr double kImpulses_Ns_kg[] = {2.0, 2.7};  // of the robot's mass: 60 and 80 N s of pegasus
constexpr double kAskedSpeed = 0.75;              // of the gait's fastest
constexpr double kFirstFallDraw = 1001.0;

double length(const Vec3& v) noexcept { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

RobotConfig that_meets(RobotConfig robot, bool meets) {
  robot.body.meets_falls = meets;
  return robot;
}

/// "yes", or what happened instead.
std::string noticed(const FallPair& pair) {
  for (const FallOutcome* one : {&pair.met, &pair.damped})
    if (one->unnoticed()) return "NO: " + one->vitals.why;
  return "yes";
}

report::Section section(const std::vector<FallPair>& pairs) {
  report::Section out{"Each push"};
  report::Table table{"On one draw, once with legs that meet the fall, once damped",
                      {"gait", "impulse (N s)", "direction", "draw", "trunk, met (N)", "trunk, damped (N)",
                       "gear, met (Nm)", "gear, damped (Nm)", "noticed"}};
  for (const FallPair& p : pairs) {
    table.rows.push_back({p.config.gait, p.config.impulse_Ns, name(p.config.direction), p.config.draw,
                          p.met.vitals.fell ? p.met.trunk_peak_N : kNaN,
                          p.damped.vitals.fell ? p.damped.trunk_peak_N : kNaN, p.met.gear_peak_Nm,
                          p.damped.gear_peak_Nm, noticed(p)});
  }
  table.note = "A robot that stays up has no force on its trunk.";
  out.tables = {table};
  return out;
}

ExperimentOutput run_falls(const ExperimentInput& in) {
  SimOptions first = in.sim;
  const auto asked = first.plant.find("draw");
  const double draw = asked != first.plant.end() ? asked->second
                                                 : kFirstFallDraw + 100.0 * static_cast<double>(in.sim.seed);
  const std::vector<FallCase> cases = fall_cases(in.robot, draw);
  const RobotConfig robots[] = {that_meets(in.robot, true), that_meets(in.robot, false)};
  const std::vector<FallOutcome> outcomes = parallel_map(
      2 * cases.size(),
      [&](std::size_t i) { return fall_once(robots[i % 2], in.preset, in.sim, cases[i / 2]); }, in.parallel);
  std::vector<FallPair> pairs;
  for (std::size_t i = 0; i < cases.size(); ++i)
    pairs.push_back({cases[i], outcomes[2 * i], outcomes[2 * i + 1]});
  const auto imu = in.sim.plant.find("imu");
  const bool foreseen = in.robot.body.imu && (imu == in.sim.plant.end() || imu->second != 0.0);
  ExperimentOutput out{fall_rows(pairs, foreseen), 0.0, {section(pairs)}};
  for (const FallOutcome& outcome : outcomes) out.simulated_s += outcome.simulated_s;
  return out;
}

}  // namespace

std::vector<FallCase> fall_cases(const RobotConfig& robot, double first_draw) {
  const double mass_kg = BodyShape(robot).mass_kg;
  std::vector<FallCase> out;
  for (const GaitConfig& gait : robot.gaits) {
    for (const double per_kg : kImpulses_Ns_kg) {
      for (const auto& direction : kWords<PushDirection>) {
        FallCase next;
        next.gait = gait.name;
        next.speed_m_s = kAskedSpeed * gait.fastest_forward_m_s;
        next.impulse_Ns = per_kg * mass_kg;
        next.direction = direction.value;
        next.draw = first_draw + static_cast<double>(out.size());
        out.push_back(next);
      }
    }
  }
  return out;
}

FallOutcome fall_once(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                      const FallCase& config) {
  SimOptions plant = lying(sim);
  plant.plant["draw"] = config.draw;
  WalkingRobot walker(robot, preset, plant);
  walker.walk(config.gait, {config.speed_m_s, 0.0, 0.0});
  walker.run(kSettleBefore_s);
  walker.push(impulse_vector_Ns(config.direction, config.impulse_Ns), kPushOver_s);
  FallOutcome out;
  double time_s = 0.0;
  walker.run(kWatched_s, [&](InProcessRobot& r) {
    time_s += robot.cycle_s;
    if (r.motion_state().state == MotionPhase::kFallen) out.noticed_s = std::fmin(out.noticed_s, time_s);
    const double trunk_N = length(r.truth().true_base_contact_force_N);
    if (trunk_N > 0.0) out.down_s = std::fmin(out.down_s, time_s);
    out.trunk_peak_N = std::max(out.trunk_peak_N, trunk_N);
    for (const TrueJoint& joint : r.truth().joints)
      out.gear_peak_Nm = std::max(out.gear_peak_Nm, std::abs(joint.true_gear_output_torque_Nm));
  });
  out.vitals = walker.vitals();
  out.simulated_s = walker.simulated_s();
  return out;
}

std::vector<ReportRow> fall_rows(const std::vector<FallPair>& pairs, bool foreseen) {
  FallOutcome met, damped;
  int both = 0, unnoticed = 0, stayed_up = 0;
  double worst_N = 0.0;
  double warned_s = 0.0;
  int warned = 0;
  for (const FallPair& p : pairs) {
    for (const FallOutcome* one : {&p.met, &p.damped}) {
      unnoticed += one->unnoticed() ? 1 : 0;
      stayed_up += one->vitals.fell ? 0 : 1;
    }
    if (!p.met.vitals.fell || !p.damped.vitals.fell) continue;
    ++both;
    const double warning_s = p.damped.down_s - p.damped.noticed_s;
    if (std::isfinite(warning_s)) {
      warned_s += warning_s;
      ++warned;
    }
    worst_N = std::max(worst_N, p.met.trunk_peak_N);
    met.trunk_peak_N += p.met.trunk_peak_N;
    met.gear_peak_Nm += p.met.gear_peak_Nm;
    damped.trunk_peak_N += p.damped.trunk_peak_N;
    damped.gear_peak_Nm += p.damped.gear_peak_Nm;
  }
  const double n = both > 0 ? static_cast<double>(both) : kNaN;
  return {row("fall.trunk_peak.met", "N", met.trunk_peak_N / n),
          row("fall.trunk_peak.damped", "N", damped.trunk_peak_N / n),
          row("fall.trunk_peak.ratio", "", met.trunk_peak_N / (both > 0 ? damped.trunk_peak_N : kNaN),
              demanded(foreseen, at_most(0.7))),
          row("fall.trunk_peak.worst", "N", worst_N),
          row("fall.gear_peak.met", "Nm", met.gear_peak_Nm / n),
          row("fall.gear_peak.damped", "Nm", damped.gear_peak_Nm / n),
          row("fall.warning", "ms", 1e3 * warned_s / (warned > 0 ? warned : kNaN)),
          row("fall.pairs", "", both),
          row("fall.stayed_up", "", stayed_up),
          row("fall.unnoticed", "", unnoticed, at_most(0.0))};
}

Experiment fall_experiment() {
  Experiment out = gait_experiment("fall", "Pushes that throw the robot over, with and without a reflex.",
                                   "How hard does the trunk hit the ground, and is every fall noticed?");
  out.seed_help = "which drawn plants are pushed, and their noise; 0 was used for tuning";
  out.in_all = {};
  out.draws_plants = true;
  out.run = run_falls;
  return out;
}

}  // namespace sprung
