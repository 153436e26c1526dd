#include "tools/lab/landing/drop_experiment.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "tools/common/parallel.h"
#include "tools/lab/landing/drop_ablation.h"

namespace sprung {

namespace {

constexpr double kCompared_m = 0.3;
constexpr double kPlotted_m = kCompared_m;
constexpr double kPlotted_s = 0.7;

struct DropSeries {
  std::vector<double> time_s, length_m, motor_Nm, output_Nm;
};

/// Of the joint that carries most at each moment.
double worst(double hip, double knee) { return std::max(std::abs(hip), std::abs(knee)); }

DropSeries watch(const RobotConfig& robot, const DropRequest& request, JumpMode mode,
                 const ScriptRunner& run) {
  DropSeries out;
  const std::int64_t release = release_cycle(robot, request.preset);
  run_drop(drop_script(robot, request.preset, request.sim, {mode, kPlotted_m, 0.0}), run,
           [&](const CycleRecord& cycle) {
             const double time_s = static_cast<double>(cycle.truth.stamp.seq - release) * robot.cycle_s;
             if (time_s < 0.0 || time_s > kPlotted_s) return;
             const auto& joints = cycle.joint_state.joints;
             const auto& truth = cycle.truth.joints;
             out.time_s.push_back(time_s);
             out.length_m.push_back(cycle.truth.base_in_world_m[2] -
                                    cycle.truth.legs.front().true_foot_in_world_m[2]);
             out.motor_Nm.push_back(worst(joints[0].motor_side_torque_Nm, joints[1].motor_side_torque_Nm));
             out.output_Nm.push_back(
                 worst(truth[0].true_gear_output_torque_Nm, truth[1].true_gear_output_torque_Nm));
           });
  return out;
}

report::Section landings(const DropExperiment& experiment) {
  report::Section out{"Landings"};
  report::Table table{"Worst of hip and knee, from touchdown until the leg stands up again",
                      {"mode", "height (m)", "motor side (Nm)", "true gear output (Nm)",
                       "foot's speed at touchdown (m/s)", "leg folded"}};
  for (const DropRow& row : experiment.landings) {
    const DropResult& r = row.result;
    table.rows.push_back({name(row.mode), row.height_m, r.peak_motor_torque_Nm, r.peak_output_torque_Nm,
                          r.touchdown_speed_m_s, r.folded ? "yes" : "no"});
  }
  out.tables = {table};
  return out;
}

report::Section comparison(const DropExperiment& experiment) {
  report::Section out{"Adaptive landing and the papers' hybrid law, floor not where it is expected"};
  report::Plot plot{"Each seed", {"touchdown later than expected", "ms"}, {"true gear output peak", "Nm"}};
  std::vector<double> x, adaptive, paper;
  for (const DropPair& pair : experiment.pairs) {
    if (pair.height_m != kCompared_m) continue;
    x.push_back(1e3 * pair.surprise_s);
    adaptive.push_back(pair.adaptive.peak_output_torque_Nm);
    paper.push_back(pair.paper.peak_output_torque_Nm);
  }
  plot.series = {{"adaptive", x, adaptive, report::Style::kPoints, 0},
                 {"papers' hybrid law", x, paper, report::Style::kPoints, 1}};
  out.plots = {plot};
  return out;
}

constexpr JumpMode kModes[] = {JumpMode::kPosition, JumpMode::kTorque, JumpMode::kHybrid,
                               JumpMode::kAdaptive};
constexpr double kHeights_m[] = {0.1, 0.2, 0.3, 0.4, 0.5};
constexpr double kSurprise_s = 0.010;
constexpr double kMostOverPaper = 0.5;
/// From the other heights the comparison has a tenth of the seeds.
constexpr int kFewerSeeds = 10;

DropRow landing(const RobotConfig& robot, const DropRequest& request, std::size_t i,
                const ScriptRunner& run) {
  const DropCase drop{kModes[i / std::size(kHeights_m)], kHeights_m[i % std::size(kHeights_m)], 0.0};
  return {drop.mode, drop.height_m, run_drop(drop_script(robot, request.preset, request.sim, drop), run)};
}

/// Height and place among its seeds of each comparison: all of kCompared_m, then a few of each height.
std::vector<std::pair<double, std::size_t>> compared(int seeds) {
  std::vector<std::pair<double, std::size_t>> out;
  out.reserve(static_cast<std::size_t>(std::max(0, seeds)));
  for (int i = 0; i < seeds; ++i) out.emplace_back(kCompared_m, i);
  for (const double height_m : kHeights_m) {
    if (height_m == kCompared_m) continue;
    for (int i = 0; i < std::max(1, seeds / kFewerSeeds); ++i) out.emplace_back(height_m, i);
  }
  return out;
}

DropPair pair(const RobotConfig& robot, const DropRequest& request, double height_m, std::size_t i,
              const ScriptRunner& run) {
  DropPair out;
  out.height_m = height_m;
  SimOptions sim = request.sim;
  sim.seed = out.seed = request.sim.seed + i;
  out.surprise_s = drawn_surprise_s(request.floor + i, kSurprise_s);
  DropCase drop{JumpMode::kAdaptive, height_m, out.surprise_s};
  out.adaptive = run_drop(drop_script(robot, request.preset, sim, drop), run);
  drop.mode = JumpMode::kHybrid;
  out.paper = run_drop(drop_script(robot, kPaperPreset, sim, drop), run);
  return out;
}

void add_landings(const std::vector<DropRow>& landings, std::vector<ReportRow>& rows) {
  for (const DropRow& l : landings) {
    const std::string name = std::string(sprung::name(l.mode)) + "_" +
                             std::to_string(std::lround(1e3 * l.height_m));
    rows.push_back(row("drop." + name + ".peak_motor_torque", "Nm", l.result.peak_motor_torque_Nm));
    rows.push_back(row("drop." + name + ".peak_output_torque", "Nm", l.result.peak_output_torque_Nm));
    rows.push_back(row("drop." + name + ".folded", "", l.result.folded ? 1 : 0));
  }
}

/// The same preset's two laws, from each height.
void add_adaptive_over_hybrid(const std::vector<DropRow>& landings, std::vector<ReportRow>& rows) {
  for (const DropRow& adaptive : landings) {
    if (adaptive.mode != JumpMode::kAdaptive) continue;
    for (const DropRow& hybrid : landings) {
      if (hybrid.mode != JumpMode::kHybrid || hybrid.height_m != adaptive.height_m) continue;
      const std::string height = std::to_string(std::lround(1e3 * adaptive.height_m));
      rows.push_back(row("drop.adaptive_over_hybrid_" + height + ".ratio", "",
                         adaptive.result.peak_output_torque_Nm / hybrid.result.peak_output_torque_Nm,
                         at_most(1.0)));
    }
  }
}

void add_comparison(const std::vector<DropPair>& pairs, std::vector<ReportRow>& rows) {
  double adaptive_Nm = 0.0, paper_Nm = 0.0, worst = 0.0, most_Nm = 0.0;
  int folded = 0;
  for (const DropPair& p : pairs) {
    adaptive_Nm += p.adaptive.peak_output_torque_Nm / static_cast<double>(pairs.size());
    paper_Nm += p.paper.peak_output_torque_Nm / static_cast<double>(pairs.size());
    worst = std::max(worst, p.adaptive.peak_output_torque_Nm / p.paper.peak_output_torque_Nm);
    most_Nm = std::max(most_Nm, p.adaptive.peak_output_torque_Nm);
    folded += p.adaptive.folded ? 1 : 0;
  }
  rows.push_back(row("drop.adaptive_over_paper.ratio", "", adaptive_Nm / paper_Nm, at_most(kMostOverPaper)));
  rows.push_back(row("drop.adaptive_over_paper.worst_ratio", "", worst, at_most(kMostOverPaper)));
  rows.push_back(row("drop.adaptive_over_paper.adaptive_mean", "Nm", adaptive_Nm));
  rows.push_back(row("drop.adaptive_over_paper.adaptive_max", "Nm", most_Nm));
  rows.push_back(row("drop.adaptive_over_paper.paper_mean", "Nm", paper_Nm));
  rows.push_back(row("drop.adaptive_over_paper.folded", "", folded, at_most(0.0)));
}

/// The same from each height, mean over mean.
void add_comparison_by_height(const std::vector<DropPair>& pairs, std::vector<ReportRow>& rows) {
  for (const double height_m : kHeights_m) {
    double adaptive_Nm = 0.0, paper_Nm = 0.0;
    for (const DropPair& p : pairs) {
      if (p.height_m != height_m) continue;
      adaptive_Nm += p.adaptive.peak_output_torque_Nm;
      paper_Nm += p.paper.peak_output_torque_Nm;
    }
    const std::string height = std::to_string(std::lround(1e3 * height_m));
    rows.push_back(row("drop.adaptive_over_paper_" + height + ".ratio", "", adaptive_Nm / paper_Nm,
                       at_most(kMostOverPaper)));
  }
}

ExperimentOutput drop_ablation(const ExperimentInput& in, const DropRequest& request) {
  if (in.asked.separate)
    throw std::invalid_argument(
        "--ablation changes parameters, which separate processes read from robot.yaml");
  const std::vector<AblationRow> ablation = run_drop_ablation(in.robot, request, run_in_process);
  ExperimentOutput out{ablation_rows(ablation)};
  out.instead = ablation_table(ablation);
  out.instead.pop_back();  // the end of its last line: whoever prints it adds one
  return out;
}

}  // namespace

std::vector<report::Section> drop_sections(const RobotConfig& robot, const DropRequest& request,
                                           const DropExperiment& experiment, const ScriptRunner& run) {
  report::Section one{"One drop from 0.3 m in each mode"};
  report::Plot length{"Leg's length", {"time since release", "s"}, {"hip to foot", "m"}};
  report::Plot output{"True gear output, worse joint", {"time since release", "s"}, {"torque", "Nm"}};
  report::Plot motor{"Motor side, worse joint", {"time since release", "s"}, {"torque", "Nm"}};
  int colour = 0;
  for (const JumpMode mode :
       {JumpMode::kPosition, JumpMode::kTorque, JumpMode::kHybrid, JumpMode::kAdaptive}) {
    const DropSeries s = watch(robot, request, mode, run);
    length.series.push_back({name(mode), s.time_s, s.length_m, report::Style::kLine, colour});
    output.series.push_back({name(mode), s.time_s, s.output_Nm, report::Style::kLine, colour});
    motor.series.push_back({name(mode), s.time_s, s.motor_Nm, report::Style::kLine, colour++});
  }
  one.plots = {length, output, motor};
  return {landings(experiment), comparison(experiment), one};
}

DropExperiment run_drop_experiment(const RobotConfig& robot, const DropRequest& asked,
                                   const ScriptRunner& run) {
  DropRequest request = asked;
  request.preset = robot.preset(asked.preset).name;
  if (request.seeds < 1) throw std::invalid_argument("--seeds must be 1 or more");
  std::atomic<std::int64_t> cycles{0};
  const ScriptRunner counted = [&](const RunScript& script, const CycleObserver& on_cycle,
                                   const ReplyObserver& on_reply) {
    run(script, on_cycle, on_reply);
    cycles += script.cycles;
  };
  const std::size_t landings = std::size(kModes) * std::size(kHeights_m);
  const auto cases = compared(request.seeds);
  const std::size_t pairs = cases.size();
  const auto from = [&](std::size_t before) {
    ParallelOptions parallel;
    parallel.jobs = request.jobs;
    if (request.on_progress)
      parallel.on_progress = [&request, before, all = landings + pairs](std::size_t done, std::size_t) {
        request.on_progress(before + done, all);
      };
    return parallel;
  };
  DropExperiment out;
  out.landings = parallel_map(
      landings, [&](std::size_t i) { return landing(robot, request, i, counted); }, from(0));
  out.pairs = parallel_map(
      pairs, [&](std::size_t i) { return pair(robot, request, cases[i].first, cases[i].second, counted); },
      from(landings));
  add_landings(out.landings, out.rows);
  add_adaptive_over_hybrid(out.landings, out.rows);
  add_comparison({out.pairs.begin(), out.pairs.begin() + request.seeds}, out.rows);
  add_comparison_by_height(out.pairs, out.rows);
  out.simulated_s = static_cast<double>(cycles) * robot.cycle_s;
  return out;
}

Experiment drop_experiment() {
  struct Own {
    int seeds = DropRequest{}.seeds;
    std::uint64_t floor = DropRequest{}.floor;
    bool ablation = false;
  };
  const auto own = std::make_shared<Own>();
  Experiment out;
  out.name = "drop";
  out.what =
      "Landings from 0.1 to 0.5 m in each mode; adaptive landing against the papers' law, floor out of "
      "place.";
  out.question =
      "How hard is a landing from 0.1 to 0.5 m in each mode, and what does sprung's own save where the floor "
      "is not where it is expected?";
  out.takes = {Common::kPreset, Common::kPlant, Common::kJobs, Common::kSeparate, Common::kOut};
  out.seed_help = "of every noise: the comparison's first, one more each time";
  out.example = "--robot single_leg --seed 1 --out /tmp/drop";
  out.in_all = {RobotKind::kLeg};
  out.many_cases = true;
  out.own.option("--seeds", own->seeds, "of the comparison");
  out.own.option("--floor", own->floor, "which floor the comparison's first fall meets, one more each time");
  out.own.flag("--ablation", own->ablation,
               "instead: adaptive landing with one part taken out at a time, as a table");
  out.run = [own](const ExperimentInput& in) {
    const DropRequest request{in.preset,  in.sim,           own->seeds,
                              own->floor, in.parallel.jobs, in.parallel.on_progress};
    if (own->ablation) return drop_ablation(in, request);
    const DropExperiment result = run_drop_experiment(in.robot, request, in.run);
    ExperimentOutput output{result.rows, result.simulated_s};
    if (in.asked.pages) output.sections = drop_sections(in.robot, request, result, in.run);
    return output;
  };
  return out;
}

}  // namespace sprung
