#include "tools/lab/commands/experiment_joint.h"

#include <sprung_version.h>

#include <chrono>
#include <cstdio>
#include <functional>
#include <memory>

#include "robots/robot_loader.h"
#include "runtime/log.h"
#include "simulation/sim_shell.h"
#include "tools/common/progress_bar.h"
#include "tools/common/report/report_shell.h"
#include "tools/lab/friction/drag_report.h"
#include "tools/lab/friction/friction_sweep_report.h"

namespace sprung::commands {
namespace {

struct JointRequest {
  std::string robot = "test_axis";
  std::string joint;
  std::uint64_t seed = 1;
  std::vector<std::string> plant;
  std::string protocol = "all";
  std::string friction = "yaml";
  std::string report;
  bool as_json = false;

  SimOptions sim() const {
    SimOptions out;
    out.seed = seed;
    out.plant = parse_plant(plant);
    return out;
  }
  /// The line that makes it again.
  std::string command(const std::string& experiment) const {
    std::string out = "sprung experiment " + experiment + " --robot " + robot;
    if (!joint.empty()) out += " --joint " + joint;
    if (protocol != "all") out += " --protocol " + protocol;
    if (friction != "yaml") out += " --friction " + friction;
    for (const std::string& change : plant) out += " --plant " + change;
    return out + " --seed " + std::to_string(seed);
  }
};

/// What one of the experiments produced, besides its rows.
struct JointOutput {
  ExperimentReport rows;
  report::Report report;
  std::string tables;
};

JointOutput begin(const JointRequest& request, const RobotConfig& robot, const std::string& experiment) {
  JointOutput out;
  out.rows.experiment = experiment;
  out.rows.robot = robot.name;
  out.rows.preset = robot.preset().name;
  out.rows.seed = request.seed;
  out.report.title = experiment + " on " + robot.name;
  out.report.subtitle =
      "seed " + std::to_string(request.seed) + ", sprung " SPRUNG_VERSION "-" SPRUNG_GIT_HASH;
  out.report.command = request.command(experiment);
  return out;
}

int finish(const JointRequest& request, const JointOutput& out) {
  if (!request.report.empty()) report::write_report(out.report, request.report);
  const std::string text = request.as_json ? out.rows.json() : out.tables + "\n" + out.rows.table();
  std::printf("%s\n", text.c_str());
  return out.rows.ok() ? kExitDone : kExitFailed;
}

int timed(const JointRequest& request, const std::string& experiment,
          const std::function<void(const RobotConfig&, JointOutput&)>& run) {
  start_log("sprung");
  const auto started = std::chrono::steady_clock::now();
  const RobotConfig robot = load_robot(request.robot);
  JointOutput out = begin(request, robot, experiment);
  with_progress(experiment, [&](ProgressBar&) { run(robot, out); });
  out.rows.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return finish(request, out);
}

std::vector<SweepProtocol> protocols(const std::string& text) {
  if (text == "all") return {SweepProtocol::kS0, SweepProtocol::kS1, SweepProtocol::kLoaded};
  return {*sweep_protocol_of(text)};
}

void run_sweep(const JointRequest& request, const RobotConfig& robot, JointOutput& out) {
  const int joint = bench_joint(robot, request.joint);
  for (const SweepProtocol protocol : protocols(request.protocol)) {
    const SweepResult result = run_friction_sweep(robot, out.rows.preset, request.sim(), joint, protocol);
    for (const ReportRow& row : sweep_rows(result, std::string("friction_sweep.") + name(protocol)))
      out.rows.rows.push_back(row);
    out.rows.simulated_s += result.recording.simulated_s;
    out.report.sections.push_back(sweep_section(result));
    out.tables += sweep_table(result);
  }
}

void add_drag(const DragResult& result, const std::string& prefix, JointOutput& out) {
  for (const ReportRow& row : drag_rows(result, prefix)) out.rows.rows.push_back(row);
  out.rows.simulated_s += result.simulated_s;
  out.report.sections.push_back(drag_section(result));
  out.tables += drag_table(result);
}

void run_drag_experiment(const JointRequest& request, const RobotConfig& robot, JointOutput& out) {
  const int joint = bench_joint(robot, request.joint);
  if (request.friction != "sweep")
    add_drag(run_drag(robot, out.rows.preset, request.sim(), joint), "drag", out);
  if (request.friction == "yaml") return;
  const RobotConfig swept = with_swept_friction(robot, out.rows.preset, request.sim(), joint);
  add_drag(run_drag(swept, out.rows.preset, request.sim(), joint), "drag_swept", out);
}

void add_common(CommandLine& line, const std::shared_ptr<JointRequest>& request) {
  line.option("--robot", request->robot, "test_axis, pegasus, or a folder");
  line.option("--joint", request->joint, "by name; default: the bench's arm, or the first knee");
  line.option("--seed", request->seed, "of every noise");
  line.option("--plant", request->plant, "KEY=VALUE changes the plant, e.g. noise_scale=2; may be repeated");
  line.option("--report", request->report, "HTML file with tables and plots");
  line.flag("--json", request->as_json, "one JSON object on standard output");
}

}  // namespace

void add_joint_experiments(CommandLine& experiment) {
  const auto sweep_request = std::make_shared<JointRequest>();
  CommandLine& sweep = experiment.subcommand("friction_sweep",
                                             "Constant speeds on one joint by the papers' protocols and with "
                                             "loads: every friction model beside the others.");
  add_common(sweep, sweep_request);
  sweep.choice("--protocol", sweep_request->protocol, {"all", "s0", "s1", "loaded"}, "which sweep");
  sweep.example("sprung experiment friction_sweep --robot pegasus --protocol s1 --report sweep.html");
  sweep.action([=] {
    return timed(*sweep_request, "friction_sweep",
                 [&](const RobotConfig& robot, JointOutput& out) { run_sweep(*sweep_request, robot, out); });
  });

  const auto drag_request = std::make_shared<JointRequest>();
  CommandLine& drag = experiment.subcommand(
      "drag",
      "The link is moved from outside: torque estimate against torque sensor, or truth where there is none.");
  add_common(drag, drag_request);
  drag.choice(
      "--friction", drag_request->friction, {"yaml", "sweep", "both"},
      "that the estimator knows: robot.yaml's, or what a loaded friction sweep of another seed finds");
  drag.example("sprung experiment drag --robot test_axis --friction both --report drag.html");
  drag.action([=] {
    return timed(*drag_request, "drag", [&](const RobotConfig& robot, JointOutput& out) {
      run_drag_experiment(*drag_request, robot, out);
    });
  });
}

}  // namespace sprung::commands
