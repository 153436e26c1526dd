#include "tools/lab/leg/foot_return.h"

#include <cmath>
#include <stdexcept>

namespace sprung {
namespace {

constexpr double kStiff_N_m = 2000.0;
constexpr double kSoft_N_m = 500.0;
constexpr double kFirstForce_N = 130.0, kForceStep_N = 15.0;        // 65 to 95 mm at kStiff without friction
constexpr double kFirstSoftForce_N = 75.0, kSoftForceStep_N = 7.5;  // friction takes up to 45 N of it

FootReturnScript script_of(const PresetConfig& preset, double stiffness_N_m, double compensation) {
  FootReturnScript out;
  out.stiffness_N_m = stiffness_N_m;
  out.damping_N_s_m = preset.compliance.damping_N_s_m[2];
  out.friction_compensation = compensation;
  out.leg_length_m = preset.stand_length_m;
  out.pulls = stiffness_N_m == kSoft_N_m ? eight_by_five(kFirstSoftForce_N, kSoftForceStep_N)
                                         : eight_by_five(kFirstForce_N, kForceStep_N);
  return out;
}

/// Five pulls of a case, or fewer.
struct Run {
  FootReturnScript part;
  RunScript script;
};

/// What it left.
struct RunResult {
  std::vector<PullResult> pulls;
  std::vector<PullTrace> traces;
};

Run run_of(const RobotConfig& robot, const std::string& preset, const SimOptions& sim, double friction_scale,
           const FootReturnScript& part) {
  Run out{part, {robot, preset, sim, orders(part, robot.cycle_s), 0}};
  out.script.sim.plant["suspended"] = part.hip_height_m;
  const auto scale = out.script.sim.plant.emplace("friction_scale", 1.0).first;
  scale->second *= friction_scale;
  out.script.controls = hand(part, robot.cycle_s);
  const double end_s =
      foot_return::kFirst_s + foot_return::kPeriod_s * static_cast<double>(part.pulls.size());
  out.script.cycles = std::llround(end_s / robot.cycle_s);
  return out;
}

RunResult result_of(const Run& run, const ScriptRunner& runner) {
  FootReturnScorer scorer(run.part);
  runner(
      run.script,
      [&](const CycleRecord& cycle) {
        const Vec3& foot_m = cycle.truth.legs.front().true_foot_in_world_m;
        const PlanePoint away{foot_m[0] - cycle.truth.base_in_world_m[0],
                              foot_m[2] - cycle.truth.base_in_world_m[2] + run.part.leg_length_m};
        const auto& commands = cycle.drive_command.actuators;
        scorer.add(static_cast<double>(cycle.drive_state.stamp.seq) * run.script.robot.cycle_s, away,
                   {commands[0].commanded_torque_Nm, commands[1].commanded_torque_Nm});
      },
      throw_unless_obeyed);
  return {scorer.results(), scorer.traces()};
}

void add(const RunResult& run, FootReturnCaseResult& out) {
  out.pulls.insert(out.pulls.end(), run.pulls.begin(), run.pulls.end());
  out.traces.insert(out.traces.end(), run.traces.begin(), run.traces.end());
}

struct Bounds {
  std::optional<double> low, high;
};

/// The table.
struct CaseBounds {
  Bounds mean, max, moved, settled, cycles, stiffness;
};

CaseBounds bounds_of(const FootReturnCase& config) {
  CaseBounds out;
  if (config.script.friction_compensation == 0.0) {
    if (config.script.stiffness_N_m == kSoft_N_m) out.mean = {23.0, 46.0};
    return out;
  }
  out.cycles = {std::nullopt, 0.0};
  const double off = std::abs(config.friction_scale - 1.0);
  if (off < 0.01) {
    out.mean.high = 1.8;
    out.max.high = 3.5;
    out.moved.low = 30.0;
    out.settled.high = PullResult::kSettle_s;
    out.stiffness = {0.8 * config.script.stiffness_N_m, 1.2 * config.script.stiffness_N_m};
  } else if (off < 0.11) {
    out.mean.high = 5.0;
  }
  return out;
}

}  // namespace

std::vector<FootReturnCase> foot_return_cases(const PresetConfig& preset) {
  const double share = preset.friction_compensation;
  std::vector<FootReturnCase> out{{"with", 1.0, script_of(preset, kStiff_N_m, share)},
                                  {"without", 1.0, script_of(preset, kStiff_N_m, 0.0)},
                                  {"soft_without", 1.0, script_of(preset, kSoft_N_m, 0.0)}};
  for (const auto& [name, scale] : {std::pair{"with_friction_80", 0.8}, std::pair{"with_friction_90", 0.9},
                                    std::pair{"with_friction_110", 1.1}, std::pair{"with_friction_120", 1.2}})
    out.push_back({name, scale, script_of(preset, kStiff_N_m, share)});
  return out;
}

FootReturnResult run_foot_return(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                                 const std::vector<FootReturnCase>& cases, const ScriptRunner& run,
                                 const ParallelOptions& parallel) {
  if (robot.legs.size() != 1 || robot.legs.front().kinematics != "two_link")
    throw std::invalid_argument("foot_return pulls a planar leg, as single_leg is; " + robot.name +
                                " is none");
  FootReturnResult out;
  std::vector<Run> runs;
  std::vector<std::size_t> case_of;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    out.cases.push_back({cases[i], {}, {}, {}});
    for (const FootReturnScript& part : runs_of(cases[i].script)) {
      runs.push_back(run_of(robot, preset, sim, cases[i].friction_scale, part));
      case_of.push_back(i);
      out.simulated_s += static_cast<double>(runs.back().script.cycles) * robot.cycle_s;
    }
  }
  const std::vector<RunResult> results = parallel_map(
      runs.size(), [&](std::size_t i) { return result_of(runs[i], run); }, parallel);
  for (std::size_t i = 0; i < runs.size(); ++i) add(results[i], out.cases[case_of[i]]);
  for (FootReturnCaseResult& done : out.cases) done.summary = summarize(done.pulls);
  return out;
}

std::vector<ReportRow> foot_return_rows(const FootReturnResult& result) {
  std::vector<ReportRow> out;
  for (const FootReturnCaseResult& done : result.cases) {
    const CaseBounds bounds = bounds_of(done.config);
    const FootReturnSummary& s = done.summary;
    const auto add = [&](const char* quantity, const char* unit, double value, const Bounds& b) {
      out.push_back(
          {"foot_return." + done.config.name + "." + quantity, unit, value, std::nullopt, b.low, b.high});
    };
    add("mean", "mm", s.mean_mm, bounds.mean);
    add("max", "mm", s.max_mm, bounds.max);
    add("min", "mm", s.min_mm, {});
    add("moved_least", "mm", s.moved_least_mm, bounds.moved);
    add("settled_worst", "s", s.settled_worst_s, bounds.settled);
    add("limit_cycles", "", s.limit_cycles, bounds.cycles);
    add("stiffness_least", "N/m", s.stiffness_least_N_m, bounds.stiffness);
    add("stiffness_most", "N/m", s.stiffness_most_N_m, bounds.stiffness);
  }
  return out;
}

}  // namespace sprung
