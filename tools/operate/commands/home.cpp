#include <cmath>
#include <cstdio>
#include <memory>

#include "drivers/bridge/reference_store_shell.h"
#include "robots/robot_loader.h"
#include "tools/commands.h"
#include "tools/operate/client/fault_request.h"
#include "tools/operate/client/health_report.h"
#include "tools/operate/client/long_command.h"
#include "tools/operate/commands/answers.h"

namespace sprung::commands {

namespace {

struct HomeRequest {
  std::string joint;
  std::string from = name(ReferenceSource::kConfigured);
  bool yes = false;
  std::string instance = "default";
};

/// Whether the position of the jig is used: asked for, or by robot.yaml.
bool needs_jig(const RobotConfig& robot, int actuator, ReferenceSource from) {
  if (from != ReferenceSource::kConfigured) return from == ReferenceSource::kJig;
  for (std::size_t i = 0; i < robot.actuators.size(); ++i) {
    const bool chosen = actuator < 0 || actuator == static_cast<int>(i);
    if (chosen && robot.actuators[i].reference.method == ReferenceMethod::kJig) return true;
  }
  return false;
}

void print_references(const RobotConfig& robot, const sprung_msgs::bus_state_t& state, int actuator) {
  for (std::size_t i = 0; i < robot.actuators.size() && i < state.nodes.size(); ++i) {
    if (actuator >= 0 && actuator != static_cast<int>(i)) continue;
    const sprung_msgs::node_health_t& node = state.nodes[i];
    const std::string& actuator_name = robot.actuators[i].name;
    if (std::isfinite(node.reference_offset_rad)) {
      std::printf("  %-24s offset %10.6f rad, from %s\n", actuator_name.c_str(), node.reference_offset_rad,
                  name(static_cast<ReferenceSource>(node.reference_source)));
    } else {
      std::printf("  %-24s not referenced\n", actuator_name.c_str());
    }
  }
}

void print_where_stored(const RobotConfig& robot, const RunInfo& info) {
  if (info.clock == "lockstep") {
    std::printf("not stored: a lock-step run must not depend on what was before\n");
    return;
  }
  const std::string file = reference_file(robot.name, info.simulation);
  std::printf("%s\n", file.empty() ? "not stored: neither $SPRUNG_STATE_DIR nor $HOME is set"
                                   : ("stored by the bridge in " + file).c_str());
}

int run_home(const HomeRequest& request) {
  const RunInfo info = require_running(request.instance, "");
  const RobotConfig robot = load_robot(info.robot_folder);
  OperatorCommand command;
  command.kind = OperatorKind::kHome;
  command.reference_source = value_named<ReferenceSource>(request.from).value();
  try {
    if (!request.joint.empty()) command.actuator = actuator_named(robot, request.joint);
  } catch (const std::invalid_argument& error) {
    throw WrongUse(error.what());
  }
  if (needs_jig(robot, command.actuator, command.reference_source) &&
      !confirmed("The robot must stand in its jig, or its zero will be wrong.", request.yes))
    return kExitFailed;
  HealthListener health(info, robot);
  const std::optional<OperatorAnswer> answer = run_long_command(info, command, health, nullptr);
  if (!report_answer("home", answer)) return kExitFailed;
  if (health.bus()) print_references(robot, *health.bus(), command.actuator);
  print_where_stored(robot, info);
  return kExitDone;
}

}  // namespace

void add_home(CommandLine& sprung) {
  const auto request = std::make_shared<HomeRequest>();
  CommandLine& home = sprung.subcommand("home",
                                        "Finds the zero of actuators that have no power and stand still.");
  home.option("joint", request->joint, "joint or actuator; default: all that robot.yaml tells how to home");
  home.choice("--from", request->from, names_of<ReferenceSource>(),
              "link encoder, motor encoder's index, or the jig that the robot stands in; configured = as "
              "robot.yaml says");
  home.flag("--yes", request->yes, "the robot stands in its jig: do not ask");
  home.option("--instance", request->instance, "which run");
  home.example("sprung home --from jig");
  home.action([=] { return run_home(*request); });
}

}  // namespace sprung::commands
