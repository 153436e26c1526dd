#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>

#include "lcmtypes/channels.h"
#include "robots/robot_loader.h"
#include "runtime/node.h"
#include "runtime/stop_request.h"
#include "signals/modes.h"
#include "tools/commands.h"
#include "tools/operate/client/health_report.h"
#include "tools/operate/client/model_report.h"
#include "tools/operate/client/motion_report.h"
#include "tools/operate/client/status_report.h"
#include "tools/operate/launcher/run_file.h"

namespace sprung::commands {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::int64_t kListen_us = 1'200'000;  // PROCESS_STATUS comes twice a second
/// For what comes by message time, once a second: enough for --speed of a fifth and more.
constexpr std::int64_t kTimeout_us = 6'000'000;
constexpr std::int64_t kLook_us = 50'000;

bool runs(const RunInfo& info, const char* program) {
  return std::any_of(info.processes.begin(), info.processes.end(), [&](const RunningProcess& process) {
    return process.program == program && std::strchr("XZTt", run_state(info, process)) == nullptr;
  });
}

/// Whether more would be heard of the bridge by waiting.
bool bridge_is_awaited(const RunInfo& info, const HeardRobot& heard) {
  return (!heard.safety.message || !heard.buses.message) && runs(info, "sprung-can-bridge");
}

template <class Message>
void take(InputQueue<Message>& queue, Newest<Message>& newest, std::int64_t now_us) {
  while (auto next = queue.pop()) newest.take(std::move(*next), now_us);
}

HeardRobot listen(const RunInfo& info, const RobotConfig& robot) {
  InputQueue<sprung_msgs::process_status_t> processes(256);
  InputQueue<sprung_msgs::motion_state_t> motions(1 << 16);
  InputQueue<sprung_msgs::joint_state_t> joint_states(64);  // only the newest counts
  InputQueue<sprung_msgs::body_state_t> bodies(64);
  InputQueue<sprung_msgs::safety_state_t> safeties(256);
  InputQueue<sprung_msgs::bus_state_t> buses(256);
  InputQueue<sprung_msgs::auxiliary_state_t> auxiliaries(16);
  HeardRobot heard;
  Node node({info.lcm_url, info.session, info.epoch_us, {}});
  node.subscribe_message(channels::kProcessStatus, CountLimits::none(), processes);
  node.subscribe_message(channels::kMotionState, CountLimits::up_to(64), motions);
  node.subscribe_message(channels::kJointState, CountLimits::exactly(robot.joints.size(), robot.legs.size()),
                         joint_states);
  node.subscribe_message(channels::kBodyState, CountLimits::none(), bodies);
  node.subscribe_message(channels::kSafetyState, CountLimits::none(), safeties);
  const std::size_t nodes = robot.actuators.size() + robot.encoder_cards.size();
  node.subscribe_message(channels::kBusState, CountLimits::exactly(robot.buses.size(), nodes), buses);
  node.subscribe_message(channels::kAuxiliaryState, CountLimits::exactly(robot.actuators.size()),
                         auxiliaries);
  node.start();
  const std::int64_t begin_us = node.utime_us();
  std::int64_t now_us = begin_us;
  const auto goes_on = [&] {
    return now_us < begin_us + kListen_us ||
           (now_us < begin_us + kTimeout_us && bridge_is_awaited(info, heard));
  };
  while (!stop_requested() && goes_on()) {
    node.wait_for_input(now_us + kLook_us);
    now_us = node.utime_us();
    while (auto status = processes.pop()) heard.processes[status->process] = *status;
    take(motions, heard.motion, now_us);
    take(joint_states, heard.joints, now_us);
    take(bodies, heard.body, now_us);
    take(safeties, heard.safety, now_us);
    take(buses, heard.buses, now_us);
    take(auxiliaries, heard.auxiliary, now_us);
  }
  heard.now_us = node.utime_us();
  return heard;
}

std::string text_of(const Json& value) { return value.is_string() ? value.get<std::string>() : value.dump(); }

/// Buses in a line each; of the nodes those that have had trouble.
void print_buses(const Json& status) {
  for (const Json& bus : status["buses"]) {
    const long long errors = bus["error_frames"].get<long long>() + bus["send_failed"].get<long long>() +
                             bus["dropped"].get<long long>() + bus["malformed"].get<long long>();
    std::printf("bus     %-10s %s, load %.1f %% worst case, %lld errors, %s strange frames\n",
                text_of(bus["name"]).c_str(), text_of(bus["condition"]).c_str(),
                100.0 * bus["load_share"].get<double>(), errors, bus["unexpected"].dump().c_str());
  }
  for (const Json& node : status["nodes"]) {
    if (text_of(node["trouble"]).empty()) continue;
    std::printf("node    %-10s %s\n", text_of(node["name"]).c_str(), text_of(node["trouble"]).c_str());
  }
}

/// What a process has complained of or last said of its work, and which do not work at all.
void print_process_news(const Json& processes) {
  for (const Json& process : processes) {
    const std::string name = text_of(process["name"]);
    const std::string state = text_of(process["state"]);
    if (state == "stopped")
      std::printf("TROUBLE %s is stopped: somebody halted it; kill -CONT %s lets it go on\n", name.c_str(),
                  process["pid"].dump().c_str());
    if (state == "dead" || state == "silent")
      std::printf("TROUBLE %s is %s: sprung up tells more; sprung down ends the run\n", name.c_str(),
                  state.c_str());
    const std::string detail = process.value("detail", "");
    if (!detail.empty()) std::printf("says    %s: %s\n", name.c_str(), detail.c_str());
    if (const long long refused = process.value("refused_messages", 0LL); refused > 0)
      std::printf("refused %s: %lld messages\n", name.c_str(), refused);
  }
}

void print_table(const Json& status) {
  std::printf("%s, clock %s, preset %s%s%s\n", text_of(status["robot"]).c_str(),
              text_of(status["clock"]).c_str(), text_of(status["preset"]).c_str(),
              status["simulation"].get<bool>() ? ", simulated drives" : "",
              status["maintenance"].get<bool>() ? ", maintenance mode" : "");
  std::printf("%-26s %-9s %8s %9s %9s  %s\n", "process", "state", "pid", "rate Hz", "overruns", "real time");
  for (const Json& process : status["processes"]) {
    char rate[32] = "-";
    if (process["rate_hz"].is_number()) {
      std::snprintf(rate, sizeof rate, "%.0f", process["rate_hz"].get<double>());
    }
    std::printf("%-26s %-9s %8s %9s %9s  %s\n", text_of(process["name"]).c_str(),
                text_of(process["state"]).c_str(), process["pid"].dump().c_str(), rate,
                process["overruns"].is_number() ? process["overruns"].dump().c_str() : "-",
                process.contains("real_time") ? text_of(process["real_time"]).c_str() : "");
  }
  print_process_news(status["processes"]);
  std::printf("%s\n", safety_text(status["safety"]).c_str());
  for (const std::string& line : motion_lines(status["motion"], status["body"]))
    std::printf("%s\n", line.c_str());
  for (const std::string& line : model_lines(status["models"])) std::printf("%s\n", line.c_str());
  for (const std::string& line : auxiliary_lines(status["auxiliary"])) std::printf("%s\n", line.c_str());
  print_buses(status);
}

int run_status(const std::string& instance, bool as_json) {
  const RunInfo info = require_running(instance, "");
  const RobotConfig robot = load_robot(info.robot_folder);
  const Json status = status_json(info, robot, listen(info, robot));
  if (as_json) {
    std::printf("%s\n", status.dump(1).c_str());
  } else {
    print_table(status);
  }
  return kExitDone;
}

}  // namespace

void add_status(CommandLine& sprung) {
  const auto instance = std::make_shared<std::string>("default");
  const auto as_json = std::make_shared<bool>(false);
  CommandLine& status = sprung.subcommand(
      "status", "Processes, safety, motion and body, buses and nodes of the robot that is up.");
  status.option("--instance", *instance, "which run");
  status.flag("--json", *as_json, "one JSON object");
  status.example("sprung status --json");
  status.action([=] { return run_status(*instance, *as_json); });
}

}  // namespace sprung::commands
