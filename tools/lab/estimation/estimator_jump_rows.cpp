#include "tools/lab/estimation/estimator_jump_rows.h"

#include "tools/lab/estimation/estimator_ensemble.h"
#include "tools/lab/estimation/estimator_runs.h"

namespace sprung {
namespace {

constexpr std::uint64_t kRuns = 5;
constexpr double kPushOff_Nm = 4.0, kPushOffWrong_Nm = 6.0, kLanding_Nm = 3.5, kLandingStiff_Nm = 8.0;
constexpr double kSoftGround_N_m = 8000.0, kStiffGround_N_m = 60000.0;

using Sums = std::vector<TorqueScore>;
using Changes = std::map<std::string, double>;

JumpScores pooled(const RobotConfig& robot, const std::string& preset, std::uint64_t seed, Changes plant) {
  JumpScores all(robot.joints.size());
  plant["sync_jitter_us"] = kScoredJitter_us;
  for (std::uint64_t run = 1; run <= kRuns; ++run)
    all.add(score_jump(robot, preset, SimOptions{100 * seed + run, plant, true}));
  return all;
}

void add_row(ExperimentReport& report, const std::string& name, const char* unit, double value,
             std::optional<double> low = std::nullopt, std::optional<double> high = std::nullopt) {
  report.rows.push_back({"estimator." + name, unit, value, std::nullopt, low, high});
}

void add_torque_rows(ExperimentReport& report, const RobotConfig& robot, const std::string& name,
                     const Sums& sums, double limit_Nm) {
  const TorqueScore& knee = sums[joint_index(robot, "knee")];
  add_row(report, name + ".rms", "Nm", knee.rms_Nm(), std::nullopt, limit_Nm);
  add_row(report, name + "_paper.rms", "Nm", knee.papers_rms_Nm());
  add_row(report, name + "_hip.rms", "Nm", sums[joint_index(robot, "hip")].rms_Nm());
}

TorqueScore over_joints(const Sums& sums) {
  TorqueScore all;
  for (const TorqueScore& sum : sums) all.add(sum);
  return all;
}

}  // namespace

void add_jump_rows(const RobotConfig& robot, const std::string& preset, std::uint64_t seed,
                   ExperimentReport& report) {
  const JumpScores soft = pooled(robot, preset, seed, {{"ground_stiffness", kSoftGround_N_m}});
  add_torque_rows(report, robot, "pushoff", soft.push_off, kPushOff_Nm);
  for (const double off : {1.25, 0.75}) {
    const JumpScores wrong = pooled(robot, preset, seed, {{"coulomb_scale", off}});
    const std::string name = off > 1.0 ? "pushoff_friction_high" : "pushoff_friction_low";
    add_torque_rows(report, robot, name, wrong.push_off, kPushOffWrong_Nm);
  }
  add_torque_rows(report, robot, "landing", soft.landing, kLanding_Nm);
  const JumpScores stiff = pooled(robot, preset, seed, {{"ground_stiffness", kStiffGround_N_m}});
  add_torque_rows(report, robot, "landing_stiff", stiff.landing, kLandingStiff_Nm);
}

void add_bounds_rows(const RobotConfig& robot, const std::string& preset, std::uint64_t seed,
                     ExperimentReport& report) {
  TorqueScore all, rest;
  for (const EnsemblePlant& plant : estimator_ensemble(seed)) {
    Changes changes = plant.changes;
    changes["sync_jitter_us"] = kScoredJitter_us;
    const JumpScores scores = score_jump(robot, preset, SimOptions{plant.seed, changes, true});
    const TorqueScore jump = over_joints(scores.jump);
    add_row(report, "bounds." + plant.name + ".coverage", "", jump.covered(), 0.85);
    all.add(jump);
    rest.add(over_joints(scores.rest));
  }
  add_row(report, "bounds.pooled.coverage", "", all.covered(), 0.93, 0.97);
  add_row(report, "bounds.pooled.rms", "Nm", all.rms_Nm());
  add_row(report, "bounds.pooled.half_width", "Nm", all.mean_bound_Nm());
  add_row(report, "bounds.pooled.half_width_over_rms", "", all.mean_bound_Nm() / all.rms_Nm(), std::nullopt,
          3.0);
  add_row(report, "bounds.rest.coverage", "", rest.covered());
  add_row(report, "bounds.rest.half_width", "Nm", rest.mean_bound_Nm());
}

}  // namespace sprung
