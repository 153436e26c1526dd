#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "robots/robot_loader.h"
#include "tools/commands.h"
#include "tools/operate/client/health_report.h"
#include "tools/operate/client/long_command.h"
#include "tools/operate/client/operator_client.h"
#include "tools/operate/commands/answers.h"

namespace sprung::commands {

namespace {

using Json = nlohmann::ordered_json;

constexpr double kAnswer_s = 3.0;
constexpr double kArming_s = 1.0;  ///< for the leg controller's next command, which arms the bridge

int run_estop(const std::string& instance) {
  OperatorClient client(require_running(instance, ""));
  OperatorCommand command;
  command.kind = OperatorKind::kEstop;
  return report_answer("estop", client.send(command, kAnswer_s)) ? kExitDone : kExitFailed;
}

void print_recovery(const RobotConfig& robot, const sprung_msgs::bus_state_t& state) {
  for (std::size_t i = 0; i < state.nodes.size(); ++i) {
    const std::string text = recovery_text(state.nodes[i]);
    if (!text.empty()) std::printf("  %-24s %s\n", node_name(robot, state.nodes[i], i).c_str(), text.c_str());
  }
  std::fflush(stdout);
}

Json clear_json(const RobotConfig& robot, const std::optional<OperatorAnswer>& answer,
                const HealthListener& health) {
  Json out{{"outcome", answer ? name(answer->outcome) : "no answer"},
           {"reason", answer ? answer->reason : ""},
           {"nodes", Json::array()},
           {"safety", safety_json(health.safety())}};
  if (health.bus()) out["nodes"] = nodes_json(robot, *health.bus());
  return out;
}

/// The bridge is cleared before it is armed again: what is shown should be what stays.
void wait_until_armed(HealthListener& health) {
  health.wait(kArming_s, [&] {
    return health.safety() && health.safety()->cause != static_cast<std::int8_t>(SafetyCause::kStarting);
  });
}

int run_clear(const std::string& instance, bool as_json) {
  const RunInfo info = require_running(instance, "");
  const RobotConfig robot = load_robot(info.robot_folder);
  HealthListener health(info, robot);
  OperatorCommand command;
  command.kind = OperatorKind::kClear;
  const auto progress = [&](const sprung_msgs::bus_state_t& state) {
    std::string waiting;
    for (std::size_t i = 0; i < state.nodes.size(); ++i) {
      if (!state.nodes[i].operational) waiting += " " + node_name(robot, state.nodes[i], i);
    }
    std::printf("clear: under way%s%s\n", waiting.empty() ? "" : ", waiting for", waiting.c_str());
    std::fflush(stdout);
  };
  const auto answer = run_long_command(info, command, health,
                                       as_json ? HealthProgress() : HealthProgress(progress));
  if (answer && answer->outcome == OperatorOutcome::kDone) wait_until_armed(health);
  if (as_json) {
    std::printf("%s\n", clear_json(robot, answer, health).dump(1).c_str());
    return answer && answer->outcome == OperatorOutcome::kDone ? kExitDone : kExitFailed;
  }
  const bool good = report_answer("clear", answer);
  if (health.bus()) print_recovery(robot, *health.bus());
  std::printf("%s\n", safety_text(safety_json(health.safety())).c_str());
  return good ? kExitDone : kExitFailed;
}

}  // namespace

void add_safety(CommandLine& sprung) {
  const auto instance = std::make_shared<std::string>("default");
  const auto as_json = std::make_shared<bool>(false);
  CommandLine& estop = sprung.subcommand("estop",
                                         "Switch every drive off at once; stays so until `sprung clear`.");
  estop.option("--instance", *instance, "which run");
  estop.example("sprung estop");
  estop.action([=] { return run_estop(*instance); });
  CommandLine& clear = sprung.subcommand("clear",
                                         "Bring the robot back from a latched cause: reset communication and "
                                         "faults where a drive needs it, and say what was done; "
                                         "torque stays off until `sprung stand`.");
  clear.option("--instance", *instance, "which run");
  clear.flag("--json", *as_json, "one JSON object: outcome, reason, nodes, safety");
  clear.example("sprung clear");
  clear.action([=] { return run_clear(*instance, *as_json); });
}

}  // namespace sprung::commands
