#include "tools/lab/estimation/adaptation_experiment.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "tools/lab/estimation/contact_experiment.h"
#include "tools/lab/gait/legged_trial.h"

namespace sprung {
namespace {

constexpr double kScoredFrom = 2.0 / 3.0;
constexpr double kWalkingShare = 0.7;  // of the gait's fastest
constexpr double kStep_s = 1.5;        // a stepping leg's, about
/// Learning makes nothing worse.
constexpr double kMostRatio = 1.0;
constexpr double kInAll_s = 30.0;

class AdaptationWatch {
 public:
  void add(const JointState& estimate, const SimTruth& truth, bool scored) {
    last_ = estimate;
    if (!scored) return;
    for (std::size_t j = 0; j < estimate.joints.size(); ++j)
      out_.torque.add(estimate.joints[j], truth.joints[j]);
  }
  AdaptationOutcome result(double simulated_s) {
    for (const EstimatedJoint& joint : last_.joints) {
      out_.least_dry = std::min(out_.least_dry, joint.dry_friction_factor);
      out_.most_dry = std::max(out_.most_dry, joint.dry_friction_factor);
      out_.least_viscous = std::min(out_.least_viscous, joint.viscous_friction_factor);
      out_.most_viscous = std::max(out_.most_viscous, joint.viscous_friction_factor);
      out_.fits = out_.fits && joint.model_fits;
    }
    out_.simulated_s = simulated_s;
    return out_;
  }

 private:
  JointState last_;
  AdaptationOutcome out_;
};

AdaptationOutcome walk_on(const RobotConfig& robot, const AdaptationTask& task) {
  OperatorCommand walk;
  walk.kind = OperatorKind::kWalk;
  walk.gait = static_cast<int>(robot.gaits.size()) - 1;
  walk.walk_speed = {kWalkingShare * robot.gaits.back().fastest_forward_m_s, 0.0, 0.0};
  LeggedTrial trial(robot, task.preset, lying(task.sim));
  trial.stand_up();
  trial.say(walk);
  AdaptationWatch watch;
  const double begin_s = trial.simulated_s();
  trial.run(task.motion_s, [&](InProcessRobot& process) {
    watch.add(process.joint_state(), process.truth(),
              trial.simulated_s() - begin_s > kScoredFrom * task.motion_s);
  });
  return watch.result(trial.simulated_s());
}

AdaptationOutcome step_on(const RobotConfig& robot, const AdaptationTask& task) {
  const int steps = std::max(3, static_cast<int>(task.motion_s / kStep_s));
  int step = 0;
  std::int64_t cycles = 0;
  AdaptationWatch watch;
  run_stepping(robot, task.preset, task.sim, steps,
               [&](const JointState& estimate, const SimTruth& truth, bool begins) {
                 step += begins ? 1 : 0;
                 ++cycles;
                 watch.add(estimate, truth, step > kScoredFrom * steps);
               });
  return watch.result(static_cast<double>(cycles) * robot.cycle_s);
}

void add_rows(const std::string& name, const AdaptationOutcome& outcome, std::vector<ReportRow>& rows) {
  const std::string prefix = "adaptation." + name;
  rows.push_back(row(prefix + ".rms", "Nm", outcome.torque.rms_Nm()));
  rows.push_back(row(prefix + ".coverage", "%", 100.0 * outcome.torque.covered()));
  rows.push_back(row(prefix + ".half_width", "Nm", outcome.torque.mean_bound_Nm()));
  rows.push_back(row(prefix + ".fits", "", outcome.fits ? 1 : 0));
}

}  // namespace

AdaptationOutcome run_adaptation(RobotConfig robot, const AdaptationTask& task, bool learns) {
  robot.estimation.adapts_friction = learns;
  return robot.gaits.empty() ? step_on(robot, task) : walk_on(robot, task);
}

std::vector<ReportRow> adaptation_rows(const AdaptationOutcome& off, const AdaptationOutcome& on) {
  std::vector<ReportRow> rows;
  add_rows("off", off, rows);
  add_rows("on", on, rows);
  rows.push_back(row("adaptation.dry_least", "", on.least_dry));
  rows.push_back(row("adaptation.dry_most", "", on.most_dry));
  rows.push_back(row("adaptation.viscous_least", "", on.least_viscous));
  rows.push_back(row("adaptation.viscous_most", "", on.most_viscous));
  rows.push_back(
      row("adaptation.rms_ratio", "", on.torque.rms_Nm() / off.torque.rms_Nm(), at_most(kMostRatio)));
  rows.push_back(row("adaptation.half_width_ratio", "",
                     on.torque.mean_bound_Nm() / off.torque.mean_bound_Nm(), at_most(kMostRatio)));
  return rows;
}

Experiment adaptation_experiment() {
  const auto motion_s = std::make_shared<double>(AdaptationTask{}.motion_s);
  Experiment out;
  out.name = "adaptation";
  out.what =
      "The same motion with friction learnt on the way and without: torque estimate, bounds and what "
      "was learnt.";
  out.question = "What does it buy to learn friction while the robot works?";
  out.takes = {Common::kPreset, Common::kPlant, Common::kJobs, Common::kOut};
  out.robot = "pegasus";
  out.in_all = {RobotKind::kLeg, RobotKind::kWalker};
  out.shorten = [motion_s] { *motion_s = kInAll_s; };
  out.example = "--plant draw=7";
  out.own.option("--seconds", *motion_s, "s of motion; the last third is scored");
  out.run = [motion_s](const ExperimentInput& in) {
    const AdaptationTask task{in.preset, in.sim, *motion_s};
    const auto outcomes = parallel_map(
        2, [&](std::size_t i) { return run_adaptation(in.robot, task, i == 1); }, in.parallel);
    return ExperimentOutput{adaptation_rows(outcomes[0], outcomes[1]),
                            outcomes[0].simulated_s + outcomes[1].simulated_s};
  };
  return out;
}

}  // namespace sprung
