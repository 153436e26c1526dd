#include "tools/lab/leg/foot_return.h"

#include <cmath>
#include <stdexcept>

#include "tools/lab/leg/hanging_return.h"
#include "tools/lab/leg/release_plots.h"

namespace sprung {

namespace {

using report::hundredths;
using report::Plot;

report::Table summary_table(const FootReturnResult& result) {
  report::Table out{
      "Where the foot stops after a release",
      {"case", "K (N/m)", "compensated", "plant's friction, masses, torque constants", "mean (mm)",
       "max (mm)", "min (mm)", "moved at least (mm)", "settled (s)", "limit cycles", "measured K (N/m)"}};
  for (const FootReturnCaseResult& done : result.cases) {
    const FootReturnSummary& s = done.summary;
    const FootReturnScript& script = done.config.script;
    out.rows.push_back({done.config.name, script.stiffness_N_m, script.friction_compensation,
                        plant_text(done.config.plant), hundredths(s.mean_mm), hundredths(s.max_mm),
                        hundredths(s.min_mm), hundredths(s.moved_least_mm), hundredths(s.settled_worst_s),
                        s.limit_cycles,
                        report::number_text(std::round(s.stiffness_least_N_m)) + " to " +
                            report::number_text(std::round(s.stiffness_most_N_m))});
  }
  out.note =
      "S0: under 1 mm with compensation, 23 to 46 mm without. The measured K is the slope of force over way "
      "between the "
      "five forces of a direction.";
  return out;
}

/// Figs. 8 and 9 of S0 are made of these.
std::vector<ReleasedFoot> released(const FootReturnResult& result) {
  std::vector<ReleasedFoot> out;
  for (const FootReturnCaseResult& done : result.cases)
    out.push_back({done.config.name, done.pulls, &done.traces});
  return out;
}

Plot distance_plot(const ReleasedFoot& foot) {
  Plot out = release_distance_plot(foot, "time from the release");
  out.shades = {{-foot_return::kGrow_s - foot_return::kHold_s, -foot_return::kHold_s, "force grows"},
                {-foot_return::kHold_s, 0.0, "held"}};
  return out;
}

report::Section foot_return_section(const FootReturnResult& result) {
  report::Section out{"Foot return"};
  out.text = {
      "The leg hangs, its foot on a virtual spring. Five pulls to a run: before each the position loops have "
      "brought the foot home (the operator's stand and stop); in compliance (comply) an "
      "outside force at the foot grows over 0.7 s, is held for 0.3 s and is gone at once. 2.5 s later the "
      "foot's distance from "
      "home is the error. A limit cycle is a foot that moves by more than 0.2 mm, or a commanded torque that "
      "changes by more than "
      "1 Nm, later than 1.5 s after the release."};
  out.tables = {summary_table(result)};
  const std::vector<ReleasedFoot> feet = released(result);
  out.plots = {release_error_plot(feet, "pull, eight directions of five forces")};
  for (std::size_t i = 0; i < feet.size(); ++i) {
    if (!result.cases[i].config.plant.as_identified()) continue;
    out.plots.push_back(release_path_plot(feet[i]));
    out.plots.push_back(distance_plot(feet[i]));
  }
  return out;
}

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
struct ReturnRun {
  FootReturnScript part;
  RunScript script;
};

/// What it left.
struct ReturnRunResult {
  std::vector<PullResult> pulls;
  std::vector<PullTrace> traces;
};

ReturnRun run_of(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                 const ReturnPlant& plant, const FootReturnScript& part) {
  ReturnRun out{part, {robot, preset, on_plant(sim, plant), orders(part, robot.cycle_s), 0}};
  out.script.sim.plant["suspended"] = part.hip_height_m;
  out.script.controls = hand(part, robot.cycle_s);
  const double end_s = foot_return::kFirst_s +
                       foot_return::kPeriod_s * static_cast<double>(part.pulls.size());
  out.script.cycles = std::llround(end_s / robot.cycle_s);
  return out;
}

ReturnRunResult result_of(const ReturnRun& run, const ScriptRunner& runner) {
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

void add(const ReturnRunResult& run, FootReturnCaseResult& out) {
  out.pulls.insert(out.pulls.end(), run.pulls.begin(), run.pulls.end());
  out.traces.insert(out.traces.end(), run.traces.begin(), run.traces.end());
}

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
  if (config.plant.as_identified()) {
    out.mean.high = 1.8;
    out.max.high = 3.5;
    out.moved.low = 30.0;
    out.settled.high = PullResult::kSettle_s;
    out.stiffness = {0.8 * config.script.stiffness_N_m, 1.2 * config.script.stiffness_N_m};
  } else {
    out.mean.high = kOtherMean_mm;
    out.max.high = kOtherMax_mm;
  }
  return out;
}

ExperimentOutput run_foot_return(const ExperimentInput& in) {
  const FootReturnResult result = run_foot_return(
      in.robot, in.preset, in.sim, foot_return_cases(in.robot.preset(in.preset)), in.run, in.parallel);
  return {foot_return_rows(result), result.simulated_s, {foot_return_section(result)}};
}

ExperimentOutput run_hanging_return(const ExperimentInput& in) {
  refuse_separate(in);
  const HangingReturnResult result = run_hanging_return(
      in.robot, in.sim, hanging_cases(in.robot, in.preset, in.sim.plant.count("draw") > 0),
      pulls_and_releases(), in.parallel);
  return {hanging_return_rows(result), result.simulated_s, {hanging_return_section(result)}};
}

}  // namespace

std::vector<FootReturnCase> foot_return_cases(const PresetConfig& preset) {
  const double share = preset.friction_compensation;
  std::vector<FootReturnCase> out{{"with", {}, script_of(preset, kStiff_N_m, share)},
                                  {"without", {}, script_of(preset, kStiff_N_m, 0.0)},
                                  {"soft_without", {}, script_of(preset, kSoft_N_m, 0.0)}};
  for (const auto& [name, plant] : other_return_plants())
    out.push_back({name, plant, script_of(preset, kStiff_N_m, share)});
  return out;
}

FootReturnResult run_foot_return(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                                 const std::vector<FootReturnCase>& cases, const ScriptRunner& run,
                                 const ParallelOptions& parallel) {
  if (robot.legs.size() != 1 || robot.legs.front().kinematics != "two_link")
    throw std::invalid_argument("foot_return pulls a planar leg, as single_leg is; " + robot.name +
                                " is none");
  FootReturnResult out;
  std::vector<ReturnRun> runs;
  std::vector<std::size_t> case_of;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    out.cases.push_back({cases[i], {}, {}, {}});
    for (const FootReturnScript& part : runs_of(cases[i].script)) {
      runs.push_back(run_of(robot, preset, sim, cases[i].plant, part));
      case_of.push_back(i);
      out.simulated_s += static_cast<double>(runs.back().script.cycles) * robot.cycle_s;
    }
  }
  const std::vector<ReturnRunResult> results = parallel_map(
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
      out.push_back(row("foot_return." + done.config.name + "." + quantity, unit, value, b));
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

Experiment foot_return_experiment() {
  Experiment out;
  out.name = "foot_return";
  out.what =
      "A hanging leg's foot is pulled away and released in eight directions with five forces, with and "
      "without friction compensation, on plants that are not as identified; of a robot that walks, the left "
      "hind foot.";
  out.question =
      "Does a foot on a virtual spring come back to where it was pulled from, and how far off without "
      "friction "
      "compensation?";
  out.takes = {Common::kPreset, Common::kPlant, Common::kSeparate, Common::kOut};
  out.example = "--seed 1 --out report";
  out.in_all = {RobotKind::kLeg, RobotKind::kWalker};
  out.many_cases = true;
  out.run = [](const ExperimentInput& in) {
    return in.robot.gaits.empty() ? run_foot_return(in) : run_hanging_return(in);
  };
  return out;
}

}  // namespace sprung
