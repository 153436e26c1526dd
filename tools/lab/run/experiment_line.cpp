#include "tools/lab/run/experiment_line.h"

#include <algorithm>

#include "signals/spelling.h"
#include "tools/lab/run/experiments.h"

namespace sprung {
namespace {

Experiment experiment_named(const std::string& name) {
  std::vector<std::string> known;
  for (Experiment& one : experiments()) {
    if (one.name == name) return std::move(one);
    known.push_back(one.name);
  }
  std::string text;
  for (const std::string& one : known) text += (text.empty() ? "" : ", ") + one;
  throw WrongUse("no experiment '" + name + "'" + did_you_mean(name, known) + "; there are: " + text);
}

}  // namespace

void add_request_options(CommandLine& line, const Experiment& experiment, ExperimentRequest& request) {
  const auto takes = [&](Common option) { return experiment.takes.count(option) > 0; };
  request.robot = experiment.robot;
  line.option("--robot", request.robot, experiment.robot_help);
  line.option("--seed", request.seed, experiment.seed_help);
  experiment.own.add_to(line);
  line.option("--set", request.set,
              "KEY=NUMBER: another number than robot.yaml's, e.g. presets.best.compliance.stiffness.z=3500; "
              "may be repeated");
  if (takes(Common::kPreset))
    line.option("--preset", request.preset,
                "set of parameters in robot.yaml; default: " + experiment.presets.alone +
                    ", else the only one" + experiment.preset_note);
  if (takes(Common::kPlant)) {
    line.option("--plant", request.plant,
                "KEY=VALUE changes the plant, e.g. friction_scale=1.2 or draw=7; may be repeated");
    line.option("--plants", request.plants,
                "N: on draws 1 to N of variation.yaml, or from --plant draw=K; rows: median and worst");
    line.choice("--position-loop", request.position_loop, {"drive", "host"},
                "who closes every actuator's; default: as robot.yaml says");
  }
  if (takes(Common::kJobs)) line.option("--jobs", request.jobs, "threads; 0: one for each core");
  if (takes(Common::kSeparate))
    line.flag("--separate", request.separate,
              "real processes over LCM instead of one process; the same bits");
}

std::unique_ptr<AskedExperiment> asked_experiment(const std::vector<std::string>& words) {
  auto asked = std::make_unique<AskedExperiment>();
  asked->experiment = experiment_named(words.empty() ? "" : words.front());
  CommandLine line("sprung experiment " + asked->experiment.name, asked->experiment.what);
  add_request_options(line, asked->experiment, asked->request);
  line.parse({words.begin() + 1, words.end()});
  return asked;
}

}  // namespace sprung
