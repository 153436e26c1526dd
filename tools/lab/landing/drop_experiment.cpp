#include "tools/lab/landing/drop_experiment.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "tools/common/parallel.h"

namespace sprung {
namespace {

constexpr JumpMode kModes[] = {JumpMode::kPosition, JumpMode::kTorque, JumpMode::kHybrid, JumpMode::kOwn};
constexpr double kHeights_m[] = {0.1, 0.2, 0.3, 0.4, 0.5};
constexpr double kCompared_m = 0.3;
constexpr double kSurprise_s = 0.010;
constexpr double kMostRatio = 0.5;
constexpr const char* kPaper = "paper";

ReportRow row(const std::string& name, const char* unit, double value) {
  return {"drop." + name, unit, value, std::nullopt, std::nullopt, std::nullopt};
}

DropRow landing(const RobotConfig& robot, const DropRequest& request, std::size_t i,
                const ScriptRunner& run) {
  const DropCase drop{kModes[i / std::size(kHeights_m)], kHeights_m[i % std::size(kHeights_m)], 0.0};
  return {drop.mode, drop.height_m, run_drop(drop_script(robot, request.preset, request.sim, drop), run)};
}

DropPair pair(const RobotConfig& robot, const DropRequest& request, std::size_t i, const ScriptRunner& run) {
  DropPair out;
  SimOptions sim = request.sim;
  sim.seed = out.seed = request.sim.seed + i;
  out.surprise_s = drawn_surprise_s(out.seed, kSurprise_s);
  DropCase drop{JumpMode::kOwn, kCompared_m, out.surprise_s};
  out.own = run_drop(drop_script(robot, request.preset, sim, drop), run);
  drop.mode = JumpMode::kHybrid;
  out.paper = run_drop(drop_script(robot, kPaper, sim, drop), run);
  return out;
}

void add_landings(const std::vector<DropRow>& landings, ExperimentReport& out) {
  for (const DropRow& l : landings) {
    const std::string name =
        std::string(sprung::name(l.mode)) + "_" + std::to_string(std::lround(1e3 * l.height_m));
    out.rows.push_back(row(name + ".peak_motor_torque", "Nm", l.result.peak_motor_torque_Nm));
    out.rows.push_back(row(name + ".peak_output_torque", "Nm", l.result.peak_output_torque_Nm));
    out.rows.push_back(row(name + ".folded", "", l.result.folded ? 1 : 0));
  }
}

/// The same preset's two laws, from each height.
void add_own_over_hybrid(const std::vector<DropRow>& landings, ExperimentReport& out) {
  for (const DropRow& own : landings) {
    if (own.mode != JumpMode::kOwn) continue;
    for (const DropRow& hybrid : landings) {
      if (hybrid.mode != JumpMode::kHybrid || hybrid.height_m != own.height_m) continue;
      const std::string height = std::to_string(std::lround(1e3 * own.height_m));
      out.rows.push_back(row("own_over_hybrid_" + height + ".ratio", "",
                             own.result.peak_output_torque_Nm / hybrid.result.peak_output_torque_Nm));
      out.rows.back().high = 1.0;
    }
  }
}

void add_comparison(const std::vector<DropPair>& pairs, ExperimentReport& out) {
  double own_Nm = 0.0, paper_Nm = 0.0, worst = 0.0, most_Nm = 0.0;
  int folded = 0;
  for (const DropPair& p : pairs) {
    own_Nm += p.own.peak_output_torque_Nm / static_cast<double>(pairs.size());
    paper_Nm += p.paper.peak_output_torque_Nm / static_cast<double>(pairs.size());
    worst = std::max(worst, p.own.peak_output_torque_Nm / p.paper.peak_output_torque_Nm);
    most_Nm = std::max(most_Nm, p.own.peak_output_torque_Nm);
    folded += p.own.folded ? 1 : 0;
  }
  out.rows.push_back(row("own_over_paper.ratio", "", own_Nm / paper_Nm));
  out.rows.back().high = kMostRatio;
  out.rows.push_back(row("own_over_paper.worst_ratio", "", worst));
  out.rows.back().high = kMostRatio;
  out.rows.push_back(row("own_over_paper.own_mean", "Nm", own_Nm));
  out.rows.push_back(row("own_over_paper.own_max", "Nm", most_Nm));
  out.rows.push_back(row("own_over_paper.paper_mean", "Nm", paper_Nm));
  out.rows.push_back(row("own_over_paper.folded", "", folded));
  out.rows.back().high = 0.0;
}

}  // namespace

DropExperiment run_drop_experiment(const RobotConfig& robot, const DropRequest& asked,
                                   const ScriptRunner& run) {
  DropRequest request = asked;
  request.preset = robot.preset(asked.preset).name;
  if (request.seeds < 1) throw std::invalid_argument("--seeds must be 1 or more");
  const auto started = std::chrono::steady_clock::now();
  std::atomic<std::int64_t> cycles{0};
  const ScriptRunner counted = [&](const RunScript& script, const CycleObserver& on_cycle,
                                   const ReplyObserver& on_reply) {
    run(script, on_cycle, on_reply);
    cycles += script.cycles;
  };
  const std::size_t landings = std::size(kModes) * std::size(kHeights_m);
  const auto pairs = static_cast<std::size_t>(request.seeds);
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
      pairs, [&](std::size_t i) { return pair(robot, request, i, counted); }, from(landings));
  out.rows.experiment = "drop";
  out.rows.robot = robot.name;
  out.rows.preset = request.preset;
  out.rows.seed = request.sim.seed;
  add_landings(out.landings, out.rows);
  add_own_over_hybrid(out.landings, out.rows);
  add_comparison(out.pairs, out.rows);
  out.rows.simulated_s = static_cast<double>(cycles) * robot.cycle_s;
  out.rows.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return out;
}

}  // namespace sprung
