#include "tools/lab/jump/jump_ensemble.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <random>

#include "tools/lab/jump/jump_experiment.h"
#include "tools/lab/run/scoring.h"

namespace sprung {
namespace {

constexpr double kJumpFriction = 0.20, kJumpMass = 0.10, kJumpTorqueConstant = 0.05;
constexpr double kSoftest_N_m = 6000.0, kHardest_N_m = 12000.0;
constexpr double kGrounds_kN_m[] = {5.0, 8.2, 15.0, 30.0, 60.0};
constexpr int kJumps = 3;            // two that adapt, and one that shows it
constexpr double kTolerance = 0.15;  // of the asked height, issue 5

double asked_height_m(const RobotConfig& robot, const JumpEnsembleRequest& request) {
  return request.height_m > 0.0 ? request.height_m : robot.preset(request.preset).jump_curve.height_m;
}

double height_of(const std::vector<JumpResult>& jumps, std::size_t i) {
  return i < jumps.size() ? jumps[i].height_mm : kNaN;
}

/// NaN where a height is missing.
double worst_error(const std::vector<JumpOutcome>& outcomes, double asked_mm, double JumpOutcome::*height) {
  double worst = 0.0;
  for (const JumpOutcome& outcome : outcomes) {
    const double error = std::abs(outcome.*height / asked_mm - 1.0);
    if (std::isnan(error)) return kNaN;
    worst = std::max(worst, error);
  }
  return worst;
}

double count_of(const std::vector<JumpOutcome>& outcomes, bool JumpOutcome::*what) {
  return static_cast<double>(std::count_if(outcomes.begin(), outcomes.end(),
                                           [&](const JumpOutcome& outcome) { return outcome.*what; }));
}

std::string short_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

}  // namespace

std::vector<JumpPlant> jump_plants(std::uint64_t ensemble, std::uint64_t seed, int count) {
  std::vector<JumpPlant> plants;
  std::mt19937_64 random(ensemble);
  for (int i = 0; i < count; ++i) {
    JumpPlant plant{"plant_" + std::to_string(i + 1), {}, 1000 * seed + static_cast<std::uint64_t>(i) + 1};
    plant.changes["friction_scale"] = 1.0 + kJumpFriction * even(random);
    plant.changes["mass_scale"] = 1.0 + kJumpMass * even(random);
    plant.changes["kt_scale"] = 1.0 + kJumpTorqueConstant * even(random);
    plant.changes["ground_stiffness"] = 0.5 * (kSoftest_N_m + kHardest_N_m) +
                                        0.5 * (kHardest_N_m - kSoftest_N_m) * even(random);
    plants.push_back(plant);
  }
  return plants;
}

std::vector<JumpPlant> ground_sweep(std::uint64_t seed) {
  std::vector<JumpPlant> plants;
  for (const double ground_kN_m : kGrounds_kN_m)
    plants.push_back({short_text(ground_kN_m), {{"ground_stiffness", 1e3 * ground_kN_m}}, seed});
  return plants;
}

JumpOutcome jump_on(const RobotConfig& robot, const JumpEnsembleRequest& request, const JumpPlant& plant) {
  JumpOutcome out;
  out.plant = plant;
  SimOptions sim;
  sim.seed = plant.seed;
  sim.plant = plant.changes;
  RunScript script = jump_script(robot, request.preset, sim, request.mode, kJumps);
  script.commands.back().jump_height_m = asked_height_m(robot, request);
  const std::int64_t first_cycle = script.commands.front().apply_at_seq;
  JumpMetrics metrics(robot);
  run_in_process(
      script,
      [&](const CycleRecord& cycle) {
        metrics.add(cycle.motion_state, cycle.joint_state, cycle.truth, &cycle.leg_command);
        const bool operational = cycle.joint_state.safety == SafetyLevel::kOperational;
        out.tripped = out.tripped || (cycle.joint_state.stamp.seq >= first_cycle && !operational);
      },
      [&](const OperatorReply& reply) {
        out.tripped = out.tripped || reply.outcome == OperatorOutcome::kRefused ||
                      reply.outcome == OperatorOutcome::kFailed;
      });
  const std::vector<JumpResult>& jumps = metrics.jumps();
  out.fell = jumps.size() < static_cast<std::size_t>(kJumps) ||
             !std::all_of(jumps.begin(), jumps.end(), [](const JumpResult& jump) { return jump.upright; });
  out.first_mm = height_of(jumps, 0);
  out.adapted_mm = height_of(jumps, kJumps - 1);
  out.simulated_s = static_cast<double>(script.cycles) * robot.cycle_s;
  return out;
}

JumpEnsemble run_jump_ensemble(const RobotConfig& robot, const JumpEnsembleRequest& request,
                               const ParallelOptions& options) {
  std::vector<JumpPlant> all = jump_plants(request.ensemble, request.seed, request.plants);
  const std::size_t drawn = all.size();
  for (const JumpPlant& ground : ground_sweep(request.seed)) all.push_back(ground);
  const std::vector<JumpOutcome> outcomes = parallel_map(
      all.size(), [&](std::size_t i) { return jump_on(robot, request, all[i]); }, options);
  const auto first_ground = outcomes.begin() + static_cast<std::ptrdiff_t>(drawn);
  JumpEnsemble out{1e3 * asked_height_m(robot, request),
                   0.0,
                   {outcomes.begin(), first_ground},
                   {first_ground, outcomes.end()}};
  for (const JumpOutcome& outcome : outcomes) out.simulated_s += outcome.simulated_s;
  return out;
}

std::vector<ReportRow> jump_ensemble_rows(const JumpEnsemble& ensemble) {
  const double asked_mm = ensemble.asked_mm;
  std::vector<ReportRow> rows = {
      row("jump_ensemble.all.asked_height", "mm", asked_mm),
      row("jump_ensemble.all.falls", "", count_of(ensemble.plants, &JumpOutcome::fell), at_most(0.0)),
      row("jump_ensemble.all.trips", "", count_of(ensemble.plants, &JumpOutcome::tripped), at_most(0.0)),
      row("jump_ensemble.all.worst_first", "",
          worst_error(ensemble.plants, asked_mm, &JumpOutcome::first_mm)),
      row("jump_ensemble.all.worst_adapted", "",
          worst_error(ensemble.plants, asked_mm, &JumpOutcome::adapted_mm), at_most(kTolerance))};
  for (const JumpOutcome& ground : ensemble.grounds) {
    const std::string place = "jump_ensemble.ground." + ground.plant.name + ".";
    rows.push_back(row(place + "first", "mm", ground.first_mm));
    rows.push_back(row(place + "adapted", "mm", ground.adapted_mm,
                       between((1.0 - kTolerance) * asked_mm, (1.0 + kTolerance) * asked_mm)));
  }
  return rows;
}

Experiment jump_ensemble_experiment() {
  struct Own {
    std::string mode = "hybrid";
    double height_mm = 0.0;
    int plants = JumpEnsembleRequest{}.plants;
    std::uint64_t ensemble = JumpEnsembleRequest{}.ensemble;
  };
  const auto own = std::make_shared<Own>();
  Experiment out;
  out.name = "jump_ensemble";
  out.what =
      "Jumps on plants with other friction, mass, torque constant and ground: falls, trips, heights before "
      "and after two jumps that adapt.";
  out.question =
      "Does the leg stay up, and jump as high as asked, on plants and grounds that it does not know?";
  out.takes = {Common::kPreset, Common::kJobs, Common::kOut};
  out.seed_help = "of every noise; 0 was used for tuning";
  out.example = "--seed 1";
  out.in_all = {RobotKind::kLeg};
  out.many_cases = true;
  out.own.choice("--mode", own->mode, names(kJumpModes), "control in the jump");
  out.own.option("--height", own->height_mm, "mm that are asked; 0 = the preset's own jump");
  out.own.option("--plants", own->plants, "how many are drawn");
  out.own.option("--ensemble", own->ensemble, "which are drawn; 0 was used for tuning");
  out.run = [own](const ExperimentInput& in) {
    const JumpEnsemble result = run_jump_ensemble(in.robot,
                                                  {in.preset, named(kJumpModes, own->mode), in.sim.seed,
                                                   own->plants, 1e-3 * own->height_mm, own->ensemble},
                                                  in.parallel);
    return ExperimentOutput{jump_ensemble_rows(result), result.simulated_s};
  };
  return out;
}

}  // namespace sprung
