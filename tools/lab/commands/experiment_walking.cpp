#include "tools/lab/commands/experiment_walking.h"

#include <sprung_version.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "robots/robot_loader.h"
#include "runtime/log.h"
#include "simulation/sim_shell.h"
#include "tools/common/progress_bar.h"
#include "tools/common/report/report_shell.h"
#include "tools/lab/commands/experiment_rows.h"
#include "tools/lab/gait/walking_experiments.h"

namespace sprung::commands {
namespace {

struct WalkingRequest {
  std::string robot = "pegasus";
  WalkingInput input;
  std::vector<std::string> plant;
  std::string out;
  bool as_json = false;
};

std::string command_line(const WalkingRequest& request, const WalkingExperiment& experiment) {
  const WalkingInput& in = request.input;
  std::string line = "sprung experiment " + experiment.name + " --robot " + request.robot + " --preset " +
                     in.preset + " --seed " + std::to_string(in.seed);
  for (const std::string& change : request.plant) line += " --plant " + change;
  if (experiment.name == "endurance")
    line += " --seeds " + std::to_string(in.seeds) + " --minutes " + report::number_text(in.minutes);
  if (experiment.name == "walk") line += " --distance " + report::number_text(in.distance_m);
  return line;
}

void write_page(const WalkingRequest& request, const WalkingExperiment& experiment,
                const WalkingOutput& output) {
  report::Report page;
  page.title = experiment.name + " of " + output.rows.robot;
  page.subtitle = "preset " + output.rows.preset + ", seed " + std::to_string(output.rows.seed) +
                  ", sprung " SPRUNG_VERSION "-" SPRUNG_GIT_HASH;
  page.command = command_line(request, experiment);
  page.sections = output.sections;
  write_rows(output.rows, request.out);
  report::write_report(page, (std::filesystem::path(request.out) / (experiment.name + ".html")).string());
}

int run_command(const WalkingRequest& request, const WalkingExperiment& experiment) {
  start_log("sprung");
  WalkingInput input = request.input;
  input.robot = load_robot(request.robot);
  input.preset = input.robot.preset(input.preset).name;
  if (input.robot.gaits.empty())
    throw WrongUse("experiment " + experiment.name + " needs a robot that walks; " + request.robot +
                   " has no gaits");
  input.plant = parse_plant(request.plant);
  ProgressBar bar(experiment.name);
  input.parallel.on_progress = [&bar](std::size_t done, std::size_t count) { bar.show(done, count); };
  const WalkingOutput output = experiment.run(input);
  if (!request.out.empty()) write_page(request, experiment, output);
  const int status = print_rows(output.rows, request.as_json);
  if (!request.as_json && !output.remark.empty()) std::printf("%s\n", output.remark.c_str());
  return status;
}

void add(CommandLine& parent, const WalkingExperiment& experiment) {
  const auto request = std::make_shared<WalkingRequest>();
  CommandLine& line = parent.subcommand(experiment.name, experiment.what);
  line.option("--robot", request->robot, "name or folder");
  line.option("--preset", request->input.preset,
              "set of parameters in robot.yaml; default: best, else the only one");
  line.option("--seed", request->input.seed, "of every noise and draw; 0 was used for tuning");
  if (experiment.name == "endurance") {
    line.option("--seeds", request->input.seeds, "how many, from --seed on");
    line.option("--minutes", request->input.minutes, "of commands for each");
  }
  if (experiment.name == "walk")
    line.option("--distance", request->input.distance_m, "m, over which speed and heading are taken");
  line.option("--jobs", request->input.parallel.jobs, "threads; 0: one for each core");
  line.option("--plant", request->plant, "KEY=VALUE changes the plant; may be repeated");
  line.option("--out", request->out, "folder for " + experiment.name + ".html and .json");
  line.flag("--json", request->as_json, "one JSON object on standard output");
  line.example("sprung experiment " + experiment.name + " --robot pegasus --seed 1 --out report");
  line.action([=] { return run_command(*request, experiment); });
}

}  // namespace

void add_walking_experiments(CommandLine& experiment) {
  for (const WalkingExperiment& one : gait_experiments()) add(experiment, one);
}

}  // namespace sprung::commands
