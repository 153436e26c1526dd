#include "tools/operate/launcher/launch_plan.h"

#include <algorithm>
#include <stdexcept>

#include "drivers/can/bus_addresses.h"

namespace sprung {

namespace {

constexpr const char* kSimDrives = "sprung-sim-drives";
constexpr const char* kImuDriver = "sprung-imu-driver";

void add_each(std::vector<std::string>& arguments, const std::string& option,
              const std::vector<std::string>& values) {
  for (const std::string& value : values) {
    arguments.insert(arguments.end(), {option, value});
  }
}

void add_injections(PlannedProcess& process, const LaunchRequest& request) {
  for (const std::string& text : request.inject) {
    const std::string prefix = process.program + "=";
    if (text.rfind(prefix, 0) == 0) {
      const std::string spec = text.substr(prefix.size());
      const bool on_can = spec.rfind("can-", 0) == 0;
      process.arguments.insert(process.arguments.end(), {on_can ? "--inject-can" : "--inject", spec});
    }
  }
}

PlannedProcess plan_process(const ProcessConfig& config, const LaunchRequest& request,
                            const RobotConfig& robot, std::int64_t session, std::int64_t epoch_us) {
  PlannedProcess process{config.program, {}, config.restart, true};
  process.arguments = {"--robot",     robot.folder,
                       "--preset",    robot.preset(request.preset).name,
                       "--session",   std::to_string(session),
                       "--epoch-us",  std::to_string(epoch_us),
                       "--lcm-url",   request.lcm_url,
                       "--clock",     request.clock,
                       "--priority",  std::to_string(config.priority),
                       "--cpu",       std::to_string(config.cpu),
                       "--rt-policy", request.rt_policy};
  if (request.simulation || request.simulated_elsewhere) process.arguments.push_back("--simulation");
  if (request.maintenance) process.arguments.push_back("--maintenance");
  add_injections(process, request);
  return process;
}

void add_bridge_options(PlannedProcess& bridge, const LaunchRequest& request) {
  add_each(bridge.arguments, "--can", request.can);
  add_each(bridge.arguments, "--cycles", {std::to_string(request.cycles)});
  add_each(bridge.arguments, "--speed", {std::to_string(request.speed)});
}

void add_simulation_options(PlannedProcess& sim, const LaunchRequest& request) {
  add_each(sim.arguments, "--can", request.can);
  add_each(sim.arguments, "--seed", {std::to_string(request.seed)});
  add_each(sim.arguments, "--plant", request.plant);
  if (!request.truth) {
    sim.arguments.push_back("--no-truth");
  }
}

/// Simulated drives publish IMU themselves: two would be one too many.
bool is_wanted(const ProcessConfig& process, const LaunchRequest& request) {
  return process.program != kImuDriver || !(request.simulation || request.simulated_elsewhere);
}

bool is_here(const ProcessConfig& process, const LaunchRequest& request) {
  return process.host == request.host && is_wanted(process, request);
}

void refuse_unknown_host(const LaunchRequest& request, const RobotConfig& robot) {
  std::string known;
  for (const ProcessConfig& process : robot.processes) {
    if (is_here(process, request)) return;
    const std::string host = process.host.empty() ? "none (leave out --host)" : process.host;
    if (known.find(host) == std::string::npos) known += (known.empty() ? "" : ", ") + host;
  }
  throw std::invalid_argument(
      request.host.empty()
          ? "every process of robot " + robot.name + " has a host: add --host, one of " + known
          : "robot " + robot.name + " gives no process to host '" + request.host + "'; its hosts: " + known);
}

/// The processes of all hosts must believe each other.
void refuse_missing_key(const LaunchRequest& request, const RobotConfig& robot) {
  if (!request.key_file.empty() || remote_processes(request, robot).empty()) return;
  throw std::invalid_argument(
      "robot " + robot.name +
      " has processes on several hosts, which need one key: make it once, (umask 077; head -c 32 "
      "/dev/urandom > sprung.key); copy it, scp -p sprung.key HOST: ; and on every host: sprung up " +
      request.robot + " --key-file sprung.key");
}

void refuse_processes(const RobotConfig& robot) {
  const auto& all = robot.processes;
  for (auto process = all.begin(); process != all.end(); ++process) {
    const auto same = [&](const ProcessConfig& other) { return other.program == process->program; };
    if (std::any_of(all.begin(), process, same))
      throw std::invalid_argument("robot " + robot.name + " lists " + process->program +
                                  " twice among its processes");
    if (process->program == kBridgeProgram && process->restart != RestartPolicy::kNever)
      throw std::invalid_argument(
          "robot " + robot.name + ": " + kBridgeProgram +
          " has restart: without_torque, but the bridge never comes back by itself; leave it out");
  }
}

}  // namespace

void check_request(const LaunchRequest& request, const RobotConfig& robot) {
  (void)robot.preset(request.preset);
  if (request.clock == "lockstep" && !request.simulation) {
    throw std::invalid_argument("--clock lockstep needs --sim: real drives do not wait");
  }
  if (request.maintenance && request.clock == "lockstep") {
    throw std::invalid_argument(
        "--maintenance holds by the second of whoever is there: without --clock lockstep");
  }
  if (request.simulation && request.simulated_elsewhere) {
    throw std::invalid_argument("--sim starts simulated drives, --sim-elsewhere says that others do: which?");
  }
  if (!request.simulation && !request.inject.empty()) {
    throw std::invalid_argument("--inject makes faults for tests: add --sim");
  }
  if (!request.simulation && (!request.plant.empty() || request.seed != 1)) {
    throw std::invalid_argument("--plant, --world and --seed are the simulation's: add --sim");
  }
  const auto is_bridge = [](const ProcessConfig& process) { return process.program == kBridgeProgram; };
  if (!std::any_of(robot.processes.begin(), robot.processes.end(), is_bridge)) {
    throw std::invalid_argument("robot " + robot.name + " lists no " + kBridgeProgram +
                                " among its processes");
  }
  refuse_processes(robot);
  refuse_unknown_host(request, robot);
  refuse_missing_key(request, robot);
  (void)bus_addresses(robot, request.can);
}

std::vector<PlannedProcess> plan_processes(const LaunchRequest& request, const RobotConfig& robot,
                                           std::int64_t session, std::int64_t epoch_us) {
  check_request(request, robot);
  std::vector<PlannedProcess> plan;
  if (request.simulation && leads(request, robot)) {
    ProcessConfig drives;
    drives.program = kSimDrives;
    drives.priority = 50;
    plan.push_back(plan_process(drives, request, robot, session, epoch_us));
    add_simulation_options(plan.back(), request);
  }
  for (const ProcessConfig& config : robot.processes) {
    if (is_here(config, request)) plan.push_back(plan_process(config, request, robot, session, epoch_us));
  }
  const auto others_first = [](const PlannedProcess& process) { return process.program != kBridgeProgram; };
  const auto bridge = std::stable_partition(plan.begin(), plan.end(), others_first);
  if (bridge != plan.end()) add_bridge_options(*bridge, request);
  return plan;
}

std::vector<RemoteProcess> remote_processes(const LaunchRequest& request, const RobotConfig& robot) {
  std::vector<RemoteProcess> remote;
  for (const ProcessConfig& config : robot.processes) {
    if (is_wanted(config, request) && !is_here(config, request))
      remote.push_back({config.program, config.host});
  }
  return remote;
}

bool leads(const LaunchRequest& request, const RobotConfig& robot) {
  return std::any_of(robot.processes.begin(), robot.processes.end(), [&](const ProcessConfig& process) {
    return process.program == kBridgeProgram && is_here(process, request);
  });
}

}  // namespace sprung
