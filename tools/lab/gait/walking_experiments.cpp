#include "tools/lab/gait/walking_experiments.h"

#include <chrono>
#include <cstdio>
#include <functional>

#include "tools/lab/gait/endurance.h"
#include "tools/lab/gait/ground_error.h"
#include "tools/lab/gait/push_experiment.h"
#include "tools/lab/gait/walk_experiment.h"

namespace sprung {
namespace {

SimOptions sim_of(const WalkingInput& input) {
  SimOptions sim;
  sim.seed = input.seed;
  sim.plant = input.plant;
  return sim;
}

WalkingOutput output(const char* experiment, const WalkingInput& input,
                     const std::function<void(WalkingOutput&)>& run) {
  const auto started = std::chrono::steady_clock::now();
  WalkingOutput out;
  out.rows.experiment = experiment;
  out.rows.robot = input.robot.name;
  out.rows.preset = input.robot.preset(input.preset).name;
  out.rows.seed = input.seed;
  run(out);
  out.rows.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return out;
}

WalkingOutput walk(const WalkingInput& input) {
  return output("walk", input, [&](WalkingOutput& out) {
    const WalkExperiment result =
        run_walk_experiment(input.robot, {input.preset, sim_of(input), input.distance_m, input.parallel});
    out.rows.rows = walk_rows(result);
    out.rows.simulated_s = result.simulated_s;
    out.sections = walk_sections(result);
  });
}

WalkingOutput ground_error(const WalkingInput& input) {
  return output("ground_error", input, [&](WalkingOutput& out) {
    GroundErrorTask task;
    task.preset = input.preset;
    task.sim = sim_of(input);
    task.parallel = input.parallel;
    const GroundErrorResult result = run_ground_error(input.robot, task);
    out.rows.rows = ground_error_rows(result);
    out.rows.simulated_s = result.simulated_s;
    out.sections = ground_error_sections(result);
  });
}

WalkingOutput push(const WalkingInput& input) {
  return output("push", input, [&](WalkingOutput& out) {
    const std::vector<PushCase> cases = push_cases();
    const std::vector<PushOutcome> outcomes =
        run_push(input.robot, {input.preset, sim_of(input), input.parallel}, cases);
    out.rows.rows = push_rows(cases, outcomes);
    for (const PushOutcome& o : outcomes) out.rows.simulated_s += o.simulated_s;
    out.sections = {push_section(outcomes)};
  });
}

WalkingOutput endurance(const WalkingInput& input) {
  return output("endurance", input, [&](WalkingOutput& out) {
    const std::vector<EnduranceOutcome> outcomes = run_endurance(
        input.robot, {input.preset, input.seed, input.seeds, input.minutes, input.plant, input.parallel});
    out.rows.rows = endurance_rows(outcomes);
    for (const EnduranceOutcome& o : outcomes) out.rows.simulated_s += o.simulated_s;
    out.sections = {endurance_section(outcomes)};
    char text[80];
    std::snprintf(text, sizeof text, "whole stack in one process: %.1f x real time on one core",
                  endurance_speed(outcomes));
    out.remark = text;
  });
}

}  // namespace

const std::vector<WalkingExperiment>& gait_experiments() {
  static const std::vector<WalkingExperiment> experiments{
      {"walk",
       "Feet in swing and touchdowns in force control, hybrid control and with pre-stance; speed and heading "
       "of the gaits.",
       "How well do feet follow in each kind of control, how hard do they land, and how straight and fast "
       "does it go?",
       walk},
      {"ground_error",
       "Ground that lies 20 mm higher or lower than feet expect, trunk fixed and free; uneven floors.",
       "What does sprung's own pre-stance save where the ground is not where it is expected?", ground_error},
      {"push",
       "Impulses at the trunk's centre in four directions: stance held in position control, on springs, "
       "trotting.",
       "How hard a push does the robot survive, at every phase of its gait, and is a fall caught?", push},
      {"endurance", "Minutes of an operator's commands at random on plants drawn from seeds, flat floor.",
       "Does the robot stay up, and do its limits hold, whatever an operator asks of it?", endurance},
  };
  return experiments;
}

}  // namespace sprung
