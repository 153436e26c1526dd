#include "tools/lab/commands/experiment_leg.h"

#include <sprung_version.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>

#include "robots/robot_loader.h"
#include "runtime/log.h"
#include "simulation/sim_shell.h"
#include "tools/common/progress_bar.h"
#include "tools/common/report/report_shell.h"
#include "tools/lab/commands/experiment_rows.h"
#include "tools/lab/gait/stand_push_report.h"
#include "tools/lab/leg/foot_return_report.h"
#include "tools/lab/leg/hanging_return_report.h"
#include "tools/lab/leg/step_response_report.h"
#include "tools/lab/run/separate_run.h"

namespace sprung::commands {
namespace {

struct LegRequest {
  std::string experiment;
  std::string robot = "single_leg";
  std::string wished;  ///< preset where none is chosen and the robot has it
  std::string preset;
  std::uint64_t seed = 1;
  std::vector<std::string> plant;
  std::string out;
  bool separate = false;
  bool as_json = false;

  std::string command() const {
    std::string line = "sprung experiment " + experiment + " --robot " + robot + " --preset " + preset;
    for (const std::string& change : plant) line += " --plant " + change;
    return line + " --seed " + std::to_string(seed) + (separate ? " --separate" : "");
  }
};

/// What an experiment leaves behind.
struct Outcome {
  std::vector<ReportRow> rows;
  report::Section section;
  double simulated_s = 0.0;
};
/// How and where its scripts are run.
struct Means {
  ScriptRunner run;
  ParallelOptions parallel;
  bool separate = false;
};
using Experiment = std::function<Outcome(const RobotConfig& robot, const std::string& preset,
                                         const SimOptions& sim, const Means& means)>;

void write_folder(const LegRequest& request, const ExperimentReport& rows, const report::Section& section) {
  report::Report page;
  page.title = request.experiment + " on " + rows.robot;
  page.subtitle = "preset " + rows.preset + ", seed " + std::to_string(rows.seed) +
                  ", sprung " SPRUNG_VERSION "-" SPRUNG_GIT_HASH;
  page.command = request.command();
  page.sections = {section};
  write_rows(rows, request.out);
  report::write_report(page, (std::filesystem::path(request.out) / (request.experiment + ".html")).string());
}

int run_command(LegRequest request, const Experiment& experiment) {
  start_log("sprung");
  const auto started = std::chrono::steady_clock::now();
  const RobotConfig robot = load_robot(request.robot);
  if (request.preset.empty()) request.preset = preset_or(robot, request.wished);
  SimOptions sim;
  sim.seed = request.seed;
  sim.plant = parse_plant(request.plant);
  ProgressBar bar(request.experiment);
  Means means{script_runner(request.separate), {}, request.separate};
  if (request.separate) means.parallel.jobs = 1;
  means.parallel.on_progress = [&bar](std::size_t done, std::size_t count) { bar.show(done, count); };
  const Outcome outcome = experiment(robot, request.preset, sim, means);
  ExperimentReport rows;
  rows.experiment = request.experiment;
  rows.robot = robot.name;
  rows.preset = request.preset;
  rows.seed = request.seed;
  rows.separate_processes = request.separate;
  rows.rows = outcome.rows;
  rows.simulated_s = outcome.simulated_s;
  rows.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  if (!request.out.empty()) write_folder(request, rows, outcome.section);
  return print_rows(rows, request.as_json);
}

/// Their hands feel where the robot is in every cycle.
void refuse_separate(const Means& means) {
  if (means.separate)
    throw std::invalid_argument("this experiment runs in one process: without --separate, please");
}

Outcome hanging_return(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                       const Means& means) {
  refuse_separate(means);
  const HangingReturnResult result =
      run_hanging_return(robot, sim, hanging_cases(robot, preset), hand_pulls(), means.parallel);
  return {hanging_return_rows(result), hanging_return_section(result), result.simulated_s};
}

Outcome stand_push(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                   const Means& means) {
  refuse_separate(means);
  const StandPushResult result = run_stand_push(robot, preset, sim, trunk_pushes(), means.parallel);
  return {stand_push_rows(result), stand_push_section(result), result.simulated_s};
}

Outcome foot_return(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                    const Means& means) {
  if (!robot.gaits.empty()) return hanging_return(robot, preset, sim, means);
  const FootReturnResult result =
      run_foot_return(robot, preset, sim, foot_return_cases(robot.preset(preset)), means.run, means.parallel);
  return {foot_return_rows(result), foot_return_section(result), result.simulated_s};
}

Outcome step_response(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                      const Means& means) {
  const StepResponseResult result = run_step_response(robot, preset, sim, means.run, means.parallel);
  return {step_response_rows(result), step_response_section(result), result.simulated_s};
}

void add(CommandLine& parent, const std::string& name, const std::string& what, const std::string& wished,
         const Experiment& experiment, const std::string& robot = "single_leg") {
  const auto request = std::make_shared<LegRequest>();
  request->experiment = name;
  request->robot = robot;
  request->wished = wished;
  CommandLine& line = parent.subcommand(name, what);
  line.option("--robot", request->robot, "name or folder");
  line.option("--preset", request->preset,
              "set of parameters in robot.yaml; default: " + wished + ", else the usual one");
  line.option("--seed", request->seed, "of every noise");
  line.option("--plant", request->plant, "KEY=VALUE changes the plant, e.g. noise_scale=2; may be repeated");
  line.flag("--separate", request->separate, "real processes over LCM instead of one process; the same bits");
  line.option("--out", request->out, "folder for " + name + ".html and " + name + ".json");
  line.flag("--json", request->as_json, "one JSON object on standard output");
  line.example("sprung experiment " + name + " --seed 1 --out report");
  line.action([=] { return run_command(*request, experiment); });
}

}  // namespace

void add_leg_experiments(CommandLine& experiment) {
  add(experiment, "foot_return",
      "A hanging leg's foot is pulled away and released in eight directions with five forces, with and "
      "without friction compensation, on plants with more and less friction; of a robot that walks, the left "
      "hind foot.",
      "best", foot_return);
  add(experiment, "stand_push",
      "A walking robot stands and is pounded, pushed down and lifted, in position control and on its virtual "
      "springs: "
      "peak torques of hip and knee above the static ones.",
      "best", stand_push, "pegasus");
  add(experiment, "step_response",
      "How fast the knee's torque follows: at the start of a jump in position control, and as a torque step "
      "with the foot "
      "on floors from rigid to soft; motor side and gear output.",
      "paper", step_response);
}

}  // namespace sprung::commands
