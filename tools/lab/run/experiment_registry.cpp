#include "tools/lab/run/experiment_registry.h"

#include <stdexcept>

#include "tools/lab/gait/gait_entries.h"
#include "tools/lab/gait/stand_push_report.h"
#include "tools/lab/jump/jump_ensemble.h"
#include "tools/lab/jump/jump_report.h"
#include "tools/lab/landing/drop_report.h"
#include "tools/lab/leg/foot_return_report.h"
#include "tools/lab/leg/hanging_return_report.h"
#include "tools/lab/leg/step_response_report.h"

namespace sprung {

namespace {

std::string paper(const RobotConfig& robot) { return preset_or(robot, "paper"); }

SimOptions sim_of(const ExperimentInput& input) {
  SimOptions sim;
  sim.seed = input.seed;
  return sim;
}

ExperimentReport rows_of(const ExperimentInput& input, const char* experiment, const std::string& preset) {
  ExperimentReport rows;
  rows.experiment = experiment;
  rows.robot = input.robot.name;
  rows.preset = preset;
  rows.seed = input.seed;
  return rows;
}

ExperimentOutput jump_output(const ExperimentInput& input) {
  const SimOptions sim = sim_of(input);
  const JumpExperiment experiment = run_jump_experiment(input.robot, paper(input.robot), sim, run_in_process);
  return {experiment.rows, jump_sections(input.robot, sim, experiment)};
}

ExperimentOutput foot_return_output(const ExperimentInput& input) {
  const PresetConfig& preset = input.robot.preset();
  const FootReturnResult result =
      run_foot_return(input.robot, preset.name, sim_of(input), foot_return_cases(preset), run_in_process);
  ExperimentOutput out{rows_of(input, "foot_return", preset.name), {foot_return_section(result)}};
  out.rows.simulated_s = result.simulated_s;
  out.rows.rows = foot_return_rows(result);
  return out;
}

ExperimentOutput hanging_return_output(const ExperimentInput& input) {
  const std::string& preset = input.robot.preset().name;
  const HangingReturnResult result = run_hanging_return(
      input.robot, sim_of(input), hanging_cases(input.robot, preset), hand_pulls(), {input.jobs, {}});
  ExperimentOutput out{rows_of(input, "foot_return", preset), {hanging_return_section(result)}};
  out.rows.simulated_s = result.simulated_s;
  out.rows.rows = hanging_return_rows(result);
  return out;
}

ExperimentOutput stand_push_output(const ExperimentInput& input) {
  const std::string& preset = input.robot.preset().name;
  const StandPushResult result =
      run_stand_push(input.robot, preset, sim_of(input), trunk_pushes(), {input.jobs, {}});
  ExperimentOutput out{rows_of(input, "stand_push", preset), {stand_push_section(result)}};
  out.rows.simulated_s = result.simulated_s;
  out.rows.rows = stand_push_rows(result);
  return out;
}

ExperimentOutput step_response_output(const ExperimentInput& input) {
  const std::string preset = paper(input.robot);
  const StepResponseResult result = run_step_response(input.robot, preset, sim_of(input), run_in_process);
  ExperimentOutput out{rows_of(input, "step_response", preset), {step_response_section(result)}};
  out.rows.simulated_s = result.simulated_s;
  out.rows.rows = step_response_rows(result);
  return out;
}

ExperimentOutput drop_output(const ExperimentInput& input) {
  DropRequest request;
  request.preset = input.robot.preset().name;
  request.sim = sim_of(input);
  request.jobs = input.jobs;
  const DropExperiment experiment = run_drop_experiment(input.robot, request, run_in_process);
  return {experiment.rows, drop_sections(input.robot, request, experiment, run_in_process)};
}

ExperimentOutput jump_ensemble_output(const ExperimentInput& input) {
  JumpEnsembleRequest request;
  request.preset = input.robot.preset().name;
  request.seed = input.seed;
  const JumpEnsemble ensemble = run_jump_ensemble(input.robot, request, {input.jobs, {}});
  ExperimentOutput out{rows_of(input, "jump_ensemble", request.preset), {}};
  out.rows.simulated_s = ensemble.simulated_s;
  out.rows.rows = jump_ensemble_rows(ensemble);
  return out;
}

/// Of a robot that walks.
std::vector<ExperimentEntry> walking_experiments(const std::string& preset) {
  return {
      {"foot_return", preset,
       "Does a foot of the hanging robot come back to where a hand took it from, and how far off without "
       "friction "
       "compensation?",
       true, hanging_return_output},
      {"stand_push", preset,
       "How much less do hip and knee carry on virtual springs than in position control when the standing "
       "robot is "
       "pounded, pushed down or lifted?",
       true, stand_push_output},
  };
}

}  // namespace

std::string ExperimentEntry::command(const std::string& robot, std::uint64_t seed) const {
  return "sprung experiment " + name + " --robot " + robot + " --preset " + preset + " --seed " +
         std::to_string(seed);
}

std::vector<ExperimentEntry> experiments_of(const RobotConfig& robot) {
  if (const char* why = robot.why_not_standing())
    throw std::invalid_argument("the experiments of `all` need a leg that stands, and " + robot.name +
                                " has none (" + why +
                                "); for a joint alone there are friction_sweep, drag and estimator");
  const std::string& preset = robot.preset().name;
  if (!robot.gaits.empty()) {
    std::vector<ExperimentEntry> out = walking_experiments(preset);
    for (ExperimentEntry& entry : gait_entries(preset)) out.push_back(entry);
    return out;
  }
  return {
      {"jump", paper(robot),
       "Are the paper's jumps met in position, torque and hybrid control, and what does sprung's own landing "
       "save?",
       false, jump_output},
      {"foot_return", preset,
       "Does a foot on a virtual spring come back to where it was pulled from, and how far off without "
       "friction compensation?",
       false, foot_return_output},
      {"step_response", paper(robot),
       "How soon is a torque there, at the motor and at the gear's output, and what do gear and ground make "
       "of it?",
       false, step_response_output},
      {"drop", preset,
       "How hard is a landing from 0.1 to 0.5 m in each mode, and what does sprung's own save where the "
       "floor is not "
       "where it is expected?",
       true, drop_output},
      {"jump_ensemble", preset,
       "Does the leg stay up, and jump as high as asked, on plants and grounds that it does not know?", true,
       jump_ensemble_output},
  };
}

}  // namespace sprung
