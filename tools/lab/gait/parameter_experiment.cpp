#include "tools/lab/gait/parameter_experiment.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "signals/number_text.h"
#include "tools/lab/gait/walking_robot.h"

namespace sprung {
namespace {

constexpr double kUnchanged_s = 2.5;       // a trot is at its speed then
constexpr double kChanged_s = 4.0;         // the ramp, and some steps
constexpr double kChangedTrotShare = 0.5;  // of its fastest: the limits' low ends then slow it down
constexpr double kStepWindow_s = 2.0, kTrotWindow_s = 0.1;
constexpr double kMostTorqueStep = 0.05;  // of the actuator's limit

constexpr ParameterMotion kParameterMotions[] = {ParameterMotion::kComply, ParameterMotion::kStand,
                                                 ParameterMotion::kTrot};

/// Of each joint, cycle by cycle.
using JointTorques = std::vector<std::vector<double>>;

double window_s(ParameterMotion motion) {
  return motion == ParameterMotion::kTrot ? kTrotWindow_s : kStepWindow_s;
}

OperatorCommand begin_of(const RobotConfig& robot, ParameterMotion motion) {
  OperatorCommand out;
  out.kind = motion == ParameterMotion::kComply ? OperatorKind::kComply : OperatorKind::kWalk;
  if (motion == ParameterMotion::kComply) return out;
  out.gait = gait_index(robot, motion == ParameterMotion::kTrot ? robot.gaits.back().name : "stand");
  if (motion == ParameterMotion::kTrot)
    out.walk_speed = {kChangedTrotShare * robot.gaits.back().fastest_forward_m_s, 0.0, 0.0};
  return out;
}

struct WatchedChange {
  ParameterTrial trial;
  JointTorques torque_Nm;
};

/// @param set nothing where its parameter is 0.
WatchedChange watch_motion(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                           ParameterMotion motion, const OperatorCommand& set) {
  WalkingRobot walker(robot, preset, sim);
  walker.say(begin_of(robot, motion));
  walker.run(kUnchanged_s);
  if (walker.refusals() > 0) throw std::runtime_error("the robot does not begin: " + walker.last_refusal());
  if (set.parameter != 0) walker.say(set);
  WatchedChange out;
  const auto cycles = static_cast<std::size_t>(window_s(motion) / robot.cycle_s);
  walker.run(kChanged_s, [&](InProcessRobot& process) {
    if (out.torque_Nm.size() >= cycles) return;
    std::vector<double>& now = out.torque_Nm.emplace_back();
    for (const EstimatedJoint& joint : process.joint_state().joints)
      now.push_back(joint.measured_motor_torque_Nm);
  });
  out.trial.refused = walker.refusals() > 0;
  out.trial.fell = walker.vitals().fell;
  out.trial.trips = walker.vitals().trips;
  return out;
}

double worst_torque_step(const RobotConfig& robot, const JointTorques& with_Nm,
                         const JointTorques& without_Nm) {
  double worst = 0.0;
  for (std::size_t k = 1; k < std::min(with_Nm.size(), without_Nm.size()); ++k) {
    for (std::size_t j = 0; j < with_Nm[k].size(); ++j) {
      const double now_Nm = with_Nm[k][j] - without_Nm[k][j];
      const double before_Nm = with_Nm[k - 1][j] - without_Nm[k - 1][j];
      worst = std::max(worst, std::abs(now_Nm - before_Nm) / robot.actuators[j].torque_limit_Nm);
    }
  }
  return worst;
}

std::vector<ParameterTrial> wanted_trials(const std::vector<Parameter>& all,
                                          const std::vector<std::string>& names) {
  std::vector<ParameterTrial> out;
  for (const std::string& name : names) (void)parameter_named(all, name);
  for (const ParameterMotion motion : kParameterMotions) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (!names.empty() && std::find(names.begin(), names.end(), all[i].name) == names.end()) continue;
      for (const double value : {all[i].least, all[i].most}) {
        if (value == all[i].file) continue;
        ParameterTrial& trial = out.emplace_back();
        trial.motion = motion;
        trial.parameter = all[i].id;
        trial.name = all[i].name;
        trial.value = value;
      }
    }
  }
  return out;
}

std::string listed_trials(const std::vector<ParameterTrial>& trials) {
  std::string out;
  for (const ParameterTrial& trial : trials) {
    if (!trial.fell && trial.trips == 0 && !trial.refused && trial.worst_step <= kMostTorqueStep) continue;
    out += std::string(name(trial.motion)) + " " + trial.name + " " + number_text(trial.value) + ": " +
           (trial.refused ? "refused" : "") + (trial.fell ? "fell " : "") +
           (trial.trips > 0 ? "tripped " : "") +
           (trial.worst_step > kMostTorqueStep ? "step " + number_text(100.0 * trial.worst_step, 3) + " %"
                                               : "") +
           "\n";
  }
  return out;
}

}  // namespace

std::vector<ParameterTrial> run_parameter_trials(const RobotConfig& robot, const std::string& preset,
                                                 const SimOptions& sim, const std::vector<std::string>& names,
                                                 const ParallelOptions& parallel) {
  const std::vector<ParameterTrial> wanted = wanted_trials(parameters_of(robot, robot.preset(preset)), names);
  const auto alone = parallel_map(
      std::size(kParameterMotions),
      [&](std::size_t i) { return watch_motion(robot, preset, sim, kParameterMotions[i], {}); }, parallel);
  return parallel_map(
      wanted.size(),
      [&](std::size_t i) {
        ParameterTrial trial = wanted[i];
        OperatorCommand set;
        set.kind = OperatorKind::kSetParameter;
        set.parameter = trial.parameter;
        set.parameter_value = trial.value;
        const WatchedChange seen = watch_motion(robot, preset, sim, trial.motion, set);
        trial.refused = seen.trial.refused;
        trial.fell = seen.trial.fell;
        trial.trips = seen.trial.trips;
        trial.worst_step = worst_torque_step(robot, seen.torque_Nm,
                                             alone[static_cast<std::size_t>(trial.motion)].torque_Nm);
        return trial;
      },
      parallel);
}

std::vector<ReportRow> parameter_rows(const std::vector<ParameterTrial>& trials) {
  std::vector<ReportRow> rows;
  for (const ParameterMotion motion : kParameterMotions) {
    double falls = 0, trips = 0, refused = 0, step = 0.0, runs = 0;
    for (const ParameterTrial& trial : trials) {
      if (trial.motion != motion) continue;
      ++runs;
      falls += trial.fell;
      trips += trial.trips;
      refused += trial.refused;
      step = std::max(step, trial.worst_step);
    }
    const std::string prefix = std::string("parameters.") + name(motion);
    rows.push_back(row(prefix + ".runs", "", runs));
    rows.push_back(row(prefix + ".refused", "", refused));
    rows.push_back(row(prefix + ".falls", "", falls, at_most(0)));
    rows.push_back(row(prefix + ".trips", "", trips, at_most(0)));
    rows.push_back(row(prefix + ".worst_step", "%", 100.0 * step, at_most(100.0 * kMostTorqueStep)));
  }
  return rows;
}

Experiment parameter_experiment() {
  const auto only = std::make_shared<std::vector<std::string>>();
  Experiment out = gait_experiment("parameters",
                                   "Each parameter set to each end of its range while the robot complies, "
                                   "stands on its springs and trots.",
                                   "Can a number that is changed while the robot runs throw it, or kick it?");
  out.in_all = {};
  out.own.option("--only", *only, "names of parameters; default: all");
  out.run = [only](const ExperimentInput& in) {
    const auto trials = run_parameter_trials(in.robot, in.preset, in.sim, *only, in.parallel);
    ExperimentOutput found;
    found.rows = parameter_rows(trials);
    found.simulated_s = static_cast<double>(trials.size()) * (kUnchanged_s + kChanged_s);
    found.before = listed_trials(trials);
    return found;
  };
  return out;
}

}  // namespace sprung
