#include "tools/launcher/launcher.h"

#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <random>
#include <stdexcept>

#include "lcmtypes/channels.h"
#include "runtime/log.h"
#include "runtime/stop_request.h"

namespace sprung {

namespace {

constexpr const char* kBridge = "sprung-can-bridge";
constexpr const char* kRecorder = "lcm-logger";
constexpr double kStop_s = 3.0;  // a bridge may damp its robot for half a second first

RunInfo describe(const LaunchRequest& request, const RobotConfig& robot) {
  RunInfo info;
  info.instance = request.instance;
  info.robot = robot.name;
  info.robot_folder = robot.folder;
  info.preset = request.preset;
  info.clock = request.clock;
  info.simulation = request.simulation;
  info.session = random_session();
  info.epoch_us = monotonic_us();
  info.lcm_url = request.lcm_url;
  info.can = request.can;
  info.launcher_pid = getpid();
  return info;
}

std::string log_path(const LaunchRequest& request, const std::string& robot) {
  std::filesystem::create_directories(request.log_folder);
  char when[32];
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  std::strftime(when, sizeof when, "%Y%m%d-%H%M%S", &local);
  return (std::filesystem::absolute(request.log_folder) / (robot + "-" + when + ".lcm")).string();
}

std::string status_text(int status) {
  return status < 128 ? "exit status " + std::to_string(status)
                      : std::string("signal ") + strsignal(status - 128);
}

}  // namespace

std::int64_t random_session() {
  std::random_device device;
  return static_cast<std::int64_t>((static_cast<std::uint64_t>(device()) << 32 | device()) >> 1) | 1;
}

std::string lcm_url_on_port(int port) {
  return "udpm://239.255.76.67:" + std::to_string(port) + "?ttl=0&recv_buf_size=4194304";
}

Launcher::Launcher(const LaunchRequest& request, const RobotConfig& robot)
    : request_(request),
      robot_(robot),
      run_file_(request.instance),
      info_(describe(request, robot)),
      plan_(plan_processes(request_, robot_, info_.session, info_.epoch_us)),
      node_(NodeOptions{request.lcm_url, info_.session, info_.epoch_us, {}}) {
  node_.subscribe_message(channels::kProcessStatus, CountLimits::none(), statuses_);
  node_.start();
  run_file_.write(info_);
}

Launcher::~Launcher() { stop(); }

void Launcher::start_all_but_bridge() {
  start_recorder();
  for (const PlannedProcess& planned : plan_) {
    if (planned.program != kBridge) {
      start(planned);
    }
  }
  for (const PlannedProcess& planned : plan_) {
    if (planned.program != kBridge) {
      wait_for(planned.program, ProcessState::kReady);
    }
  }
}

void Launcher::start_bridge() {
  start(plan_.back());
  wait_for(kBridge, ProcessState::kRunning);
}

void Launcher::start_recorder() {
  if (request_.log_folder.empty()) {
    return;
  }
  info_.log = log_path(request_, robot_.name);
  start({kRecorder, {"--lcm-url=" + request_.lcm_url, "-q", "-f", info_.log}});
}

void Launcher::start(const PlannedProcess& planned) {
  const std::string path = planned.program == kRecorder ? system_program(kRecorder, "liblcm-bin")
                                                        : program_folder() + "/" + planned.program;
  children_.push_back({planned.program, std::make_unique<ChildProcess>(path, planned.arguments), false});
  info_.processes.push_back({planned.program, children_.back().process->pid()});
  run_file_.write(info_);
}

ProcessState Launcher::state_of(const std::string& program) {
  while (auto status = statuses_.pop()) {
    last_status_[status->process] = *status;
  }
  const auto found = last_status_.find(program);
  return found == last_status_.end() ? ProcessState::kStarting
                                     : static_cast<ProcessState>(found->second.state);
}

void Launcher::wait_for(const std::string& program, ProcessState state) {
  const std::int64_t end_us = node_.utime_us() + std::llround(request_.patience_s * 1e6);
  while (state_of(program) < state) {
    refuse_the_dead();
    if (stop_requested()) {
      throw std::runtime_error("stopped while starting");
    }
    if (node_.utime_us() > end_us) {
      throw std::runtime_error(program + " is not " + name(state) + " after " +
                               std::to_string(request_.patience_s) + " s: " + last_status_[program].detail);
    }
    node_.wait_for_input(node_.utime_us() + 20'000);
  }
}

void Launcher::refuse_the_dead() {
  for (const Ended& ended : newly_ended()) {
    throw std::runtime_error(ended.program + " ended while starting: " + status_text(ended.status));
  }
}

std::vector<Launcher::Ended> Launcher::newly_ended() {
  std::vector<Ended> ended;
  for (Child& child : children_) {
    if (!child.reported && child.process->ended()) {
      child.reported = true;
      ended.push_back({child.program, *child.process->ended()});
    }
  }
  return ended;
}

std::size_t Launcher::running() const {
  const auto runs = [](const Child& child) { return !child.process->ended(); };
  return static_cast<std::size_t>(std::count_if(children_.begin(), children_.end(), runs));
}

void Launcher::stop_one(Child& child, double patience_s) {
  if (!child.process->ended()) {
    child.process->stop(patience_s);
  }
  child.reported = true;
}

void Launcher::stop() {
  const auto stop_if = [&](auto chosen) {
    for (auto child = children_.rbegin(); child != children_.rend(); ++child) {
      if (chosen(child->program)) {
        stop_one(*child, kStop_s);
      }
    }
  };
  stop_if([](const std::string& program) { return program == kBridge; });
  stop_if([](const std::string& program) { return program != kRecorder; });
  const bool recording = !children_.empty() && children_.front().program == kRecorder;
  if (recording && !children_.front().process->ended()) {
    usleep(200'000);  // facts L13b: the recorder ends at least this long after the last message
    stop_one(children_.front(), kStop_s);
  }
}

}  // namespace sprung
