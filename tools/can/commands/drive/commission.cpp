#include <cmath>
#include <cstdio>
#include <memory>

#include "runtime/session_clock.h"
#include "runtime/stop_request.h"
#include "runtime/utc_text.h"
#include "tools/can/commands/drive/drive_bench.h"
#include "tools/can/commands/drive/drive_commands.h"
#include "tools/can/commission/live_port.h"
#include "tools/can/commission/simulated_bench.h"
#include "tools/can/commission/terminal_person.h"
#include "tools/can/commission/walk.h"
#include "tools/can/commission/wired_drives.h"
#include "tools/can/node_inspection.h"
#include "tools/common/report/report_shell.h"

namespace sprung::commands {
namespace {

using namespace commission;

struct CommissionRequest {
  DriveRequest drive;
  WalkOptions walk;
  std::string answers;  ///< file
  std::string report;   ///< HTML
  bool simulated = false, factory = false, no_power = false;
};

/// Of the actuators among the nodes that were asked for. @throws WrongUse where there is none.
std::vector<int> chosen(const DriveBench& bench, const std::string& node) {
  const std::vector<ActuatorConfig>& actuators = bench.robot().actuators;
  std::vector<int> out;
  for (const cantools::NodeDescription& one : bench.nodes(node)) {
    for (std::size_t i = 0; i < actuators.size(); ++i)
      if (actuators[i].name == one.name) out.push_back(static_cast<int>(i));
  }
  if (out.empty()) throw WrongUse("'" + node + "' is no drive: an encoder card has nothing to commission");
  return out;
}

Protocol walk_simulated(const RobotConfig& robot, const DriveTiming& timing, int actuator,
                        const CommissionRequest& request) {
  BenchSetup setup;
  setup.bus = robot.actuators[static_cast<std::size_t>(actuator)].bus;
  setup.actuator = actuator;
  setup.joint = robot.joint_of_actuator(actuator);
  setup.sim.wiring = std::vector<sim::DriveWiring>(robot.actuators.size());
  const std::size_t index = static_cast<std::size_t>(actuator);
  setup.sim.wiring[index] = request.factory ? factory_drive(robot.actuators[index])
                                            : commissioned_drive(robot.actuators[index]);
  SimulatedBench bench(robot, setup);
  if (!request.drive.as_json) bench.print_steps(true);
  return Walk(robot, actuator, timing, request.walk, bench, bench).run();
}

Protocol walk_live(DriveBench& bench, int actuator, const CommissionRequest& request) {
  const int bus = bench.robot().actuators[static_cast<std::size_t>(actuator)].bus;
  if (bridge_drives(bench.bus(bus)))
    throw std::runtime_error("a bridge drives " + bench.bus(bus).describe() +
                             " (SYNC or its heartbeat was heard): sprung down first");
  LivePort port(bench.bus(bus));
  TerminalPerson person(request.answers, request.drive.yes, !request.drive.as_json);
  return Walk(bench.robot(), actuator, bench.timing(), request.walk, port, person).run();
}

std::string command_of(const CommissionRequest& request, const RobotConfig& robot) {
  std::string text = "sprung drive commission " + robot.name;
  if (!request.drive.node.empty()) text += " " + request.drive.node;
  if (request.simulated) text += request.factory ? " --sim --factory" : " --sim";
  if (request.walk.write) text += " --write";
  if (request.no_power) text += " --no-power";
  return text;
}

report::Report page_of(const std::vector<Protocol>& protocols, const RobotConfig& robot,
                       const CommissionRequest& request) {
  report::Report page{"Commissioning of " + robot.name,
                      request.simulated ? "simulated drives and hand: says nothing about a robot"
                                        : utc_text(utc_us(), ' ') + " UTC",
                      command_of(request, robot)};
  for (const Protocol& one : protocols) page.sections.push_back(protocol_section(one));
  return page;
}

int run_commission(CommissionRequest request) {
  install_stop_signals();
  request.walk.power = !request.no_power;
  DriveBench bench(request.drive.where);
  std::vector<Protocol> protocols;
  bool ok = true;
  for (const int actuator : chosen(bench, request.drive.node)) {
    if (!request.drive.as_json)
      std::printf("%s\n", bench.robot().actuators[static_cast<std::size_t>(actuator)].name.c_str());
    protocols.push_back(request.simulated ? walk_simulated(bench.robot(), bench.timing(), actuator, request)
                                          : walk_live(bench, actuator, request));
    ok = ok && protocols.back().ok();
    if (!request.drive.as_json) std::printf("%s\n", summary_text(protocols.back()).c_str());
    if (stop_requested()) break;
  }
  if (request.drive.as_json) std::printf("%s\n", protocol_json(protocols).c_str());
  if (!request.report.empty())
    report::write_report(page_of(protocols, bench.robot(), request), request.report);
  return ok ? kExitDone : kExitFailed;
}

}  // namespace

void add_drive_commission(CommandLine& drive) {
  const auto request = std::make_shared<CommissionRequest>();
  CommandLine& line = add_with_robot(
      drive, "commission",
      "A checked walk from a factory drive to `sprung home`: what is read, what a hand does, then little "
      "current; status 1 where something differs or is left.",
      request->drive);
  line.option("node", request->drive.node, "actuator's name or node id; default: every drive in turn");
  line.flag("--write", request->walk.write, "offer to write what differs, where its meaning is confirmed");
  line.flag("--no-power", request->no_power, "end before the first current");
  line.option("--answers", request->answers, "YAML file with an answer for each question, for scripts");
  line.flag("--yes", request->drive.yes,
            "take every suggested answer; never for power: that needs --answers");
  line.option("--report", request->report, "HTML file: the protocol");
  line.flag("--sim", request->simulated, "simulated drives, plant and hand in this process");
  line.flag("--factory", request->factory, "with --sim: the drive is as its maker sells it");
  line.flag("--json", request->drive.as_json, "a JSON array of drives with their findings");
  add_bus_choice(line, request->drive);
  line.example("sprung drive commission single_leg knee_motor --report knee.html");
  line.action([=] { return run_commission(*request); });
}

}  // namespace sprung::commands
