#include "tools/commands/experiment_leg.h"

#include <sprung_version.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>

#include "drivers/sim/sim_shell.h"
#include "robots/robot_loader.h"
#include "runtime/log.h"
#include "tools/experiments/foot_return_report.h"
#include "tools/report/report_shell.h"

namespace sprung::commands {
namespace {

struct Request {
  std::string robot = "single_leg";
  std::string preset = "best";
  std::uint64_t seed = 1;
  std::vector<std::string> plant;
  std::string out;
  bool as_json = false;

  std::string command() const {
    std::string line = "sprung experiment foot_return --robot " + robot + " --preset " + preset;
    for (const std::string& change : plant) line += " --plant " + change;
    return line + " --seed " + std::to_string(seed);
  }
};

void write_folder(const Request& request, const ExperimentReport& rows, const FootReturnResult& result) {
  report::Report page;
  page.title = "foot_return on " + rows.robot;
  page.subtitle = "preset " + rows.preset + ", seed " + std::to_string(rows.seed) +
                  ", sprung " SPRUNG_VERSION "-" SPRUNG_GIT_HASH;
  page.command = request.command();
  page.sections = {foot_return_section(result)};
  const std::filesystem::path folder = request.out;
  std::filesystem::create_directories(folder);
  report::write_report(page, (folder / "foot_return.html").string());
  std::ofstream file(folder / "foot_return.json");
  file << rows.json() << "\n";
  if (!file) throw std::runtime_error("cannot write " + (folder / "foot_return.json").string());
}

int run_foot_return_command(const Request& request) {
  start_log("sprung");
  const auto started = std::chrono::steady_clock::now();
  const RobotConfig robot = load_robot(request.robot);
  SimOptions sim;
  sim.seed = request.seed;
  sim.plant = parse_plant(request.plant);
  const FootReturnResult result = run_foot_return(
      robot, request.preset, sim, foot_return_cases(robot.preset(request.preset)), run_in_process);
  ExperimentReport rows;
  rows.experiment = "foot_return";
  rows.robot = robot.name;
  rows.preset = request.preset;
  rows.seed = request.seed;
  rows.rows = foot_return_rows(result);
  rows.simulated_s = result.simulated_s;
  rows.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  if (!request.out.empty()) write_folder(request, rows, result);
  std::printf("%s\n", (request.as_json ? rows.json() : rows.table()).c_str());
  return rows.ok() ? kExitDone : kExitFailed;
}

}  // namespace

void add_leg_experiments(CommandLine& experiment) {
  const auto request = std::make_shared<Request>();
  CommandLine& foot = experiment.subcommand(
      "foot_return",
      "A hanging leg's foot is pulled away and released in eight directions with five forces, with and "
      "without friction compensation, on plants with more and less friction.");
  foot.option("--robot", request->robot, "name or folder");
  foot.option("--preset", request->preset, "set of parameters in robot.yaml");
  foot.option("--seed", request->seed, "of every noise");
  foot.option("--plant", request->plant, "KEY=VALUE changes the plant, e.g. noise_scale=2; may be repeated");
  foot.option("--out", request->out, "folder for foot_return.html and foot_return.json");
  foot.flag("--json", request->as_json, "one JSON object on standard output");
  foot.example("sprung experiment foot_return --seed 1 --out report");
  foot.action([=] { return run_foot_return_command(*request); });
}

}  // namespace sprung::commands
