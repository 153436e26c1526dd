#include "tools/lab/estimation/model_watch_experiment.h"

#include <algorithm>
#include <cmath>

#include "tools/lab/identify/record_in_process.h"

namespace sprung {
namespace {

constexpr double kSoon_s = 1.0;
/// Enough motion to judge by; shorter stops than a recording that is fitted.
constexpr identify::RecordOptions kMoves{1.5, 0.1};

/// A recording is made with the first preset that there is, whose estimator may be the papers'.
RobotConfig with_preset_alone(RobotConfig robot, const std::string& preset) {
  robot.presets = {robot.preset(preset)};
  return robot;
}

WatchedJoint watch_joint(const RobotConfig& robot, const SimOptions& sim, std::size_t joint) {
  WatchedJoint out{robot.joints[joint].name};
  const auto watch = [&](const CycleRecord& cycle) {
    const EstimatedJoint& estimated = cycle.joint_state.joints[joint];
    out.simulated_s += robot.cycle_s;
    if (std::abs(estimated.estimated_velocity_rad_s) > WatchedJoint::kMoves_rad_s)
      out.motion_s += robot.cycle_s;
    if (!estimated.model_fits && !out.misfit_after_s) out.misfit_after_s = out.motion_s;
  };
  identify::record_in_process(robot, sim, static_cast<int>(joint), kMoves, watch);
  return out;
}

double share(const std::vector<WatchedJoint>& joints, bool (*counts)(const WatchedJoint&)) {
  return static_cast<double>(std::count_if(joints.begin(), joints.end(), counts)) /
         static_cast<double>(joints.size());
}

ExperimentOutput run_model_watch(const ExperimentInput& in) {
  const std::vector<WatchedJoint> joints = watch_models(with_preset_alone(in.robot, in.preset), in.sim,
                                                        in.parallel);
  ExperimentOutput out{model_watch_rows(joints)};
  for (const WatchedJoint& joint : joints) out.simulated_s += joint.simulated_s;
  return out;
}

}  // namespace

std::vector<WatchedJoint> watch_models(const RobotConfig& robot, const SimOptions& sim,
                                       const ParallelOptions& parallel) {
  return parallel_map(
      robot.joints.size(), [&](std::size_t joint) { return watch_joint(robot, sim, joint); }, parallel);
}

std::vector<ReportRow> model_watch_rows(const std::vector<WatchedJoint>& joints) {
  std::vector<ReportRow> rows;
  rows.reserve(joints.size() + 2);
  for (const WatchedJoint& joint : joints)
    rows.push_back(
        row("model_watch." + joint.name + ".misfit_after", "s", joint.misfit_after_s.value_or(kNaN)));
  rows.push_back(row("model_watch.misfit_within_1s", "", share(joints, [](const WatchedJoint& joint) {
                       return joint.misfit_after_s && *joint.misfit_after_s <= kSoon_s;
                     })));
  rows.push_back(row("model_watch.fits", "",
                     share(joints, [](const WatchedJoint& joint) { return !joint.misfit_after_s; }),
                     at_least(1.0)));
  return rows;
}

Experiment model_watch_experiment() {
  Experiment out;
  out.name = "model_watch";
  out.what =
      "Each joint of the hung-up robot makes the moves of a guided recording: how soon `model_fits` says no.";
  out.question = "Does the robot notice when its gears are not those of robot.yaml?";
  out.takes = {Common::kPreset, Common::kPlant, Common::kJobs, Common::kOut};
  out.robot = "single_leg";
  out.in_all = {RobotKind::kJoint, RobotKind::kLeg, RobotKind::kWalker};
  out.example = "--plant family=erob_100 --plant draw=3";
  out.run = run_model_watch;
  return out;
}

}  // namespace sprung
