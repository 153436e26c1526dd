#include "tools/lab/run/experiment.h"

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <map>

#include "robots/robot_loader.h"
#include "simulation/plant/plant_words.h"
#include "tools/lab/run/drawn_plants.h"
#include "tools/lab/run/separate_run.h"

namespace sprung {
namespace {

std::string common_words_of(const Experiment& experiment, const ExperimentRequest& request,
                            const std::string& preset) {
  std::string line = " --robot " + request.robot;
  if (experiment.takes.count(Common::kPreset) > 0) line += " --preset " + preset;
  for (const std::string& number : request.set) line += " --set " + number;
  line += plant_words(request);
  if (!request.position_loop.empty()) line += " --position-loop " + request.position_loop;
  return line + " --seed " + std::to_string(request.seed);
}

std::string preset_of(const Experiment& experiment, const ExperimentRequest& request,
                      const RobotConfig& robot) {
  if (!request.preset.empty()) return robot.preset(request.preset).name;
  return preset_or(robot, request.in_all ? experiment.presets.in_all : experiment.presets.alone);
}

std::pair<std::string, double> number_of(const std::string& text) {
  const std::size_t equals = text.find('=');
  const std::string number = equals == std::string::npos ? "" : text.substr(equals + 1);
  char* end = nullptr;
  const double value = std::strtod(number.c_str(), &end);
  if (equals == 0 || number.empty() || *end != '\0' || !std::isfinite(value))
    throw WrongUse("--set " + text +
                   ": expected KEY=NUMBER, a number's way in robot.yaml, '=' and the number alone, in " +
                   "the unit of the file: presets.best.compliance.stiffness.z=3500");
  return {text.substr(0, equals), value};
}

/// The other processes, and some experiments, read robot.yaml themselves.
void refuse_what_nobody_reads(const Experiment& experiment, const ExperimentRequest& request) {
  if (request.set.empty()) return;
  if (request.separate) throw WrongUse("--set runs in one process: without --separate, or change robot.yaml");
  if (experiment.reads_files)
    throw WrongUse("experiment " + experiment.name + " reads robot.yaml itself, --set has no say there: " +
                   "copy the robot's folder and change it");
}

/// The other processes read robot.yaml themselves.
RobotConfig with_position_loop(const ExperimentRequest& request, RobotConfig robot) {
  if (request.position_loop.empty()) return robot;
  if (request.separate)
    throw WrongUse("--position-loop runs in one process: without --separate, or change robot.yaml");
  for (ActuatorConfig& actuator : robot.actuators)
    actuator.position_loop = request.position_loop == "host" ? PositionLoopSide::kHost
                                                             : PositionLoopSide::kDrive;
  return robot;
}

ExperimentReport report_of(const Experiment& experiment, const ExperimentInput& input) {
  ExperimentReport rows;
  rows.experiment = experiment.name;
  rows.robot = input.robot.name;
  rows.preset = input.preset;
  rows.seed = input.sim.seed;
  rows.separate_processes = input.asked.separate;
  return rows;
}

FinishedExperiment run_or_failure(const Experiment& experiment, const ExperimentInput& input) {
  try {
    return run_experiment(experiment, input);
  } catch (const std::exception& error) {
    return {experiment.name, experiment.question, input.command, report_of(experiment, input), {},
            error.what()};
  }
}

}  // namespace

void OwnOptions::choice(const std::string& name, std::string& value, const std::vector<std::string>& allowed,
                        const std::string& help) {
  add([=, &value](CommandLine& line) { line.choice(name, value, allowed, help); },
      [=, &value] { return words_of(name, value); });
}

void OwnOptions::flag(const std::string& name, bool& value, const std::string& help) {
  add([=, &value](CommandLine& line) { line.flag(name, value, help); },
      [=, &value] { return value ? " " + name : std::string(); });
}

void OwnOptions::add_to(CommandLine& line) const {
  for (const auto& option : options_) option.first(line);
}

std::string OwnOptions::words() const {
  std::string out;
  for (const auto& option : options_) out += option.second();
  return out;
}

std::string OwnOptions::words_of(const std::string& name, const std::string& value) {
  return value.empty() ? "" : " " + name + " " + value;
}
std::string OwnOptions::words_of(const std::string& name, const std::vector<std::string>& values) {
  std::string out;
  for (const std::string& value : values) out += words_of(name, value);
  return out;
}
std::string OwnOptions::words_of(const std::string& name, double value) {
  return words_of(name, report::number_text(value));
}
std::string OwnOptions::words_of(const std::string& name, int value) {
  return words_of(name, std::to_string(value));
}
std::string OwnOptions::words_of(const std::string& name, std::uint64_t value) {
  return words_of(name, std::to_string(value));
}

std::string plant_words(const ExperimentRequest& request) {
  std::string out;
  for (const std::string& change : request.plant) out += " --plant " + change;
  return out + (request.plants > 0 ? " --plants " + std::to_string(request.plants) : "");
}

RobotConfig robot_of(const ExperimentRequest& request) {
  std::map<std::string, double> numbers;
  for (const std::string& text : request.set) {
    if (!numbers.insert(number_of(text)).second)
      throw WrongUse("--set " + text + ": this number is set twice");
  }
  return load_robot(request.robot, numbers);
}

ExperimentInput experiment_input(const Experiment& experiment, const ExperimentRequest& request,
                                 const RobotConfig& robot) {
  ExperimentInput input;
  input.asked = request;
  input.robot = with_position_loop(request, robot);
  refuse_what_nobody_reads(experiment, request);
  input.preset = preset_of(experiment, request, robot);
  if (experiment.needs_gaits && robot.gaits.empty())
    throw WrongUse("experiment " + experiment.name + " needs a robot that walks; " + request.robot +
                   " has no gaits");
  if (experiment.draws_plants && request.plants > 0)
    throw WrongUse("experiment " + experiment.name +
                   " draws its plants itself: without --plants; --plant draw=K says the first");
  input.sim.seed = request.seed;
  input.sim.plant = parse_plant(request.plant);
  input.run = script_runner(request.separate);
  input.parallel.jobs = request.separate ? 1 : request.jobs;
  input.common_words = common_words_of(experiment, request, input.preset);
  input.command = "sprung experiment " + experiment.name + input.common_words + experiment.own.words() +
                  (request.separate ? " --separate" : "");
  return input;
}

void refuse_separate(const ExperimentInput& input) {
  if (input.asked.separate)
    throw std::invalid_argument("this experiment runs in one process: without --separate, please");
}

FinishedExperiment run_experiment(const Experiment& experiment, const ExperimentInput& input) {
  const auto started = std::chrono::steady_clock::now();
  ExperimentOutput said = input.asked.plants > 0 ? run_on_drawn_plants(experiment, input)
                                                 : experiment.run(input);
  FinishedExperiment out{
      experiment.name, experiment.question, input.command, report_of(experiment, input), std::move(said), ""};
  out.rows.rows = std::move(out.output.rows);
  out.rows.simulated_s = out.output.simulated_s;
  out.rows.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return out;
}

std::vector<FinishedExperiment> run_experiments(
    const std::vector<Experiment>& experiments, const ExperimentRequest& request, const RobotConfig& robot,
    const std::function<void(std::size_t, std::size_t)>& on_progress) {
  std::vector<FinishedExperiment> finished(experiments.size());
  const auto run_one = [&](std::size_t i, int jobs) {
    if (experiments[i].shorten) experiments[i].shorten();
    ExperimentRequest asked = request;
    asked.jobs = jobs;
    if (experiments[i].takes.count(Common::kPlant) == 0) {  // it has plants of its own
      asked.plant.clear();
      asked.plants = 0;
    }
    finished[i] = run_or_failure(experiments[i], experiment_input(experiments[i], asked, robot));
  };
  std::vector<std::size_t> small;
  std::size_t done = 0;
  const auto tell = [&] {
    ++done;
    if (on_progress) on_progress(done, experiments.size());
  };
  for (std::size_t i = 0; i < experiments.size(); ++i) {
    if (!experiments[i].many_cases) {
      small.push_back(i);
      continue;
    }
    run_one(i, request.jobs);
    tell();
  }
  run_parallel(small.size(), [&](std::size_t i) { run_one(small[i], 1); },
               {request.jobs, [&](std::size_t, std::size_t) { tell(); }});
  return finished;
}

}  // namespace sprung
