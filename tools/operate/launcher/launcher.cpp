#include "tools/operate/launcher/launcher.h"

#include <signal.h>
#include <sprung_version.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <utility>

#include "lcmtypes/channels.h"
#include "robots/robot_loader.h"
#include "runtime/key_source.h"
#include "runtime/process_options.h"
#include "runtime/resource_use.h"
#include "runtime/stop_request.h"
#include "runtime/types_hash.h"
#include "tools/operate/launcher/lead_finder.h"
#include "tools/operate/launcher/recorder_plan.h"
#include "tools/operate/launcher/run_conflict.h"

namespace sprung {

namespace {

constexpr double kStop_s = 3.0;           // a bridge may damp its robot for half a second first
constexpr double kStopRecorder_s = 10.0;  // a disk that is slow must still get everything

BuildIdentity own_identity(const LaunchRequest& request, const RobotConfig& robot) {
  const std::string preset = robot.preset(request.preset).name;
  return {SPRUNG_VERSION, SPRUNG_GIT_HASH, types_hash(), configuration_hash(robot, preset),
          robot.name,     request.clock};
}

/// What cannot be is refused before anything is locked, or another host is waited for.
bool checked_leads(const LaunchRequest& request, const RobotConfig& robot) {
  check_request(request, robot);
  return leads(request, robot);
}

std::vector<RunInfo> others(const std::string& instance) {
  std::vector<RunInfo> runs = runs_that_are_up();
  const auto is_own = [&](const RunInfo& run) { return run.instance == instance; };
  runs.erase(std::remove_if(runs.begin(), runs.end(), is_own), runs.end());
  return runs;
}

/// All of them by name: which one is in the way is the operator's to judge.
std::string do_not_end(const std::vector<RunningProcess>& left) {
  std::string names, pids;
  for (const RunningProcess& process : left) {
    const std::string pid = std::to_string(process.pid);
    names += (names.empty() ? "" : ", ") + process.program + " (process " + pid + ")";
    pids += " " + pid;
  }
  return names + " of a run whose launcher was killed " + (left.size() == 1 ? "does" : "do") +
         " not end. Press the emergency stop, then: kill -9" + pids;
}

/// Two bridges on one bus: the one whose launcher was killed is still bringing its drives to rest.
/// @throws std::runtime_error where one does not end.
void wait_for_left_behind(const LaunchRequest& request) {
  const std::int64_t end_us = monotonic_us() + std::llround(request.timeout_s * 1e6);
  for (auto left = left_behind(request.instance); !left.empty(); left = left_behind(request.instance)) {
    if (stop_requested()) throw std::runtime_error("stopped while starting");
    if (monotonic_us() > end_us) throw std::runtime_error(do_not_end(left));
    usleep(20'000);
  }
}

}  // namespace

Launcher::Launcher(const LaunchRequest& request, const RobotConfig& robot)
    : request_(request),
      robot_(robot),
      leads_(checked_leads(request, robot)),
      key_(request.key_file.empty() ? random_key() : read_key_file(request.key_file)),
      run_file_(request.instance),
      info_(leads_ ? describe_run(request, robot) : describe_joined_run(request, robot)),
      plan_(plan_processes(request_, robot_, info_.session, info_.epoch_us)),
      remote_(remote_processes(request_, robot_)),
      identity_(own_identity(request_, robot_)),
      mixed_builds_(std::getenv("SPRUNG_MIXED_BUILDS") != nullptr),
      node_(NodeOptions{request.lcm_url, info_.session, info_.epoch_us, {}}),
      publisher_(node_.publisher<ProcessStatus>(channels::kProcessStatus)) {
  node_.subscribe_message(channels::kProcessStatus, CountLimits::none(), statuses_);
  node_.subscribe_message(channels::kSafetyState, CountLimits::none(), safeties_);
  wait_for_left_behind(request);
  run_file_.write_key(*key_);
  run_file_.write(info_);  // first, so that of two that begin at once none misses the other
  const std::string conflict = why_not_beside(info_, others(request.instance));
  if (!conflict.empty()) throw std::runtime_error(conflict);
  node_.start();
}

Launcher::~Launcher() {
  stop();
  node_.stop();
}

void Launcher::start_all_but_bridge() {
  start_recorder();
  const auto each = [&](const auto& act) {
    for (const PlannedProcess& planned : plan_) {
      if (planned.program != kBridgeProgram) act(planned);
    }
  };
  each([&](const PlannedProcess& planned) { start(planned); });
  each([&](const PlannedProcess& planned) { wait_for(planned.program, ProcessState::kReady); });
  state_ = ProcessState::kReady;
  for (const RemoteProcess& remote : remote_) {
    if (remote.program != kBridgeProgram) wait_for(remote.program, ProcessState::kReady);
  }
}

void Launcher::start_bridge() {
  if (leads_) start(plan_.back());
  wait_for(kBridgeProgram, ProcessState::kRunning);
  state_ = ProcessState::kRunning;
}

void Launcher::start_recorder() {
  if (request_.log_folder.empty()) return;
  info_.log = log_path(request_.log_folder, robot_.name);
  line_file_.open(lines_path(info_.log));
  const PlannedProcess planned = plan_recorder(request_, robot_, info_);
  info_.log = first_file(info_.log, request_.recording);
  start(planned);
  children_.back().end.harmless = true;
  if (says_status(children_.back().planned)) wait_for(children_.back().planned.program, ProcessState::kReady);
}

std::unique_ptr<ChildProcess> Launcher::run_program(const PlannedProcess& planned) const {
  const std::string path = planned.program == kLcmLogger ? system_program(kLcmLogger, "liblcm-bin")
                                                         : program_folder() + "/" + planned.program;
  std::vector<std::string> arguments = planned.arguments;
  if (!planned.gets_key) return std::make_unique<ChildProcess>(path, arguments, Output::kCaptured);
  const KeyFd key(*key_);  // each its own, to be read from its begin
  arguments.insert(arguments.end(), {"--key-fd", std::to_string(key.number())});
  return std::make_unique<ChildProcess>(path, arguments, Output::kCaptured, key.number());
}

void Launcher::start(const PlannedProcess& planned) {
  EndedProcess end;
  end.policy = planned.restart;
  end.lockstep = request_.clock == "lockstep";
  std::unique_ptr<ChildProcess> process = run_program(planned);
  Child& child = children_.emplace_back();
  child.planned = planned;
  child.process = std::move(process);
  child.end = end;
  info_.processes.push_back({planned.program, child.process->pid()});
  run_file_.write(info_);
}

/// A log that was cut off stays as it is.
void Launcher::start_new_log(Child& recorder) {
  RunInfo info = info_;
  info.log = log_path(request_.log_folder, robot_.name);
  recorder.planned = plan_recorder(request_, robot_, info);
  recorder.process = run_program(recorder.planned);
  info_.log = first_file(info.log, request_.recording);
}

void Launcher::start_anew(Child& child) {
  board_.forget(child.planned.program);
  if (child.end.harmless)
    start_new_log(child);
  else
    child.process = run_program(child.planned);
  child.reported = false;
  for (RunningProcess& process : info_.processes) {
    if (process.program == child.planned.program) process.pid = child.process->pid();
  }
  run_file_.write(info_);
}

/// Where that fails the run goes on as it would have without.
void Launcher::start_again(Child& child) {
  const std::string& program = child.planned.program;
  read_lines(child);
  ++child.end.restarts;
  try {
    start_anew(child);
  } catch (const std::exception& error) {
    child.end.restarts = RestartRule::kMost;
    return trouble_.push_back(program + " is not started again: " + error.what());
  }
  say(program + " was started again (" + std::to_string(child.end.restarts) + " of at most " +
      std::to_string(RestartRule::kMost) + " times)" +
      (child.end.harmless ? "" : "; torque stays off: sprung clear, sprung stand"));
}

void Launcher::start_again_what_may() {
  bool waiting = false;
  for (Child& child : children_) {
    if (!child.reported || !child.process->ended() || !RestartRule::hopeful(child.end)) continue;
    waiting = waiting || !child.end.harmless;
    if (waiting && torque_watch_ == nullptr)
      torque_watch_ = std::make_unique<TorqueWatch>(
          NodeOptions{
              request_.lcm_url, info_.session, info_.epoch_us, {}, key_, request_.clock == "lockstep"},
          robot_);
    const auto torque = torque_watch_ != nullptr ? torque_watch_->heard() : std::nullopt;
    if (RestartRule::due(child.end, torque, node_.utime_us())) start_again(child);
  }
  if (!waiting) torque_watch_.reset();
}

void Launcher::wait_for(const std::string& program, ProcessState state) {
  const std::int64_t end_us = node_.utime_us() + std::llround(request_.timeout_s * 1e6);
  for (look(); board_.state_of(program) < state; look()) {
    refuse_trouble();
    if (stop_requested()) throw std::runtime_error("stopped while starting");
    if (lead_is_gone()) throw std::runtime_error("the launcher of the host that has the bridge has ended");
    if (node_.utime_us() > end_us) throw std::runtime_error(not_ready_text(program, state));
    node_.wait_for_input(node_.utime_us() + 20'000);
  }
  refuse_trouble();
}

std::string Launcher::not_ready_text(const std::string& program, ProcessState state) const {
  const auto* const status = board_.last(program);
  char after[32];
  std::snprintf(after, sizeof after, " after %g s", request_.timeout_s);
  std::string text = program + " is not " + name(state) + after;
  for (const RemoteProcess& remote : remote_) {
    if (remote.program != program) continue;
    text += "; start it there: sprung up " + request_.robot +
            (remote.host.empty() ? "" : " --host " + remote.host) +
            ", with an --lcm-url whose ttl is 1 on every host";
  }
  if (status != nullptr && !status->detail.empty()) text += ": " + status->detail;
  if (program == kBridgeProgram && leads_ && !request_.simulation)
    text += ". With simulated drives: sprung up " + request_.robot + " --sim";
  const std::string refusal = node_.last_refusal();
  return refusal.empty() ? text : text + " (" + refusal + ")";
}

void Launcher::refuse_trouble() {
  for (const Ended& ended : newly_ended()) {
    throw std::runtime_error(ended.program + " ended while starting: " + exit_text(ended.status));
  }
  if (!trouble_.empty()) throw std::runtime_error(trouble_.front());
}

void Launcher::read_lines(Child& child) {
  std::vector<std::string> lines = child.lines.add(child.process->output());
  if (child.process->ended()) {
    const std::string rest = child.lines.rest();
    if (!rest.empty()) lines.push_back(rest);
  }
  for (std::string& line : lines) tell({utc_us(), child.planned.program, std::move(line)});
}

void Launcher::tell(const LogLine& line) {
  if (line_file_.is_open()) line_file_ << dated(line) << std::endl;  // whole also after a crash
  if (sink_) return sink_(line);
  std::fprintf(stderr, "%s\n", dated(line).c_str());
}

void Launcher::say(const std::string& text) { tell({utc_us(), kLauncherProgram, text}); }

/// In lock-step the bridge brings its drives to rest in the robot's time. How long that is by the wall clock
/// nobody knows: as long as it says that it lives, it is on its way.
void Launcher::wait_while_it_speaks(Child& child) {
  const std::string& program = child.planned.program;
  const bool spoke = board_.last(program) != nullptr;
  child.process->signal(SIGTERM);
  while (spoke && !child.process->ended() && !board_.silent(program, node_.utime_us())) {
    usleep(20'000);
    read_statuses();
    read_lines(child);
  }
}

void Launcher::stop_one(Child& child, double timeout_s) {
  if (!child.process->ended() && child.process->stop(timeout_s) == 128 + SIGKILL) {
    stopped_in_order_ = false;
    say("error " + child.planned.program + " did not end when asked and was killed" +
        (child.planned.program == kBridgeProgram ? ": the drives were left to their own watchdogs" : ""));
  }
  child.reported = true;
  read_lines(child);
}

void Launcher::stop() {
  state_ = ProcessState::kStopping;
  publish_status();
  const auto stop_if = [&](const auto& chosen) {
    for (auto child = children_.rbegin(); child != children_.rend(); ++child) {
      if (chosen(*child)) stop_one(*child, child->end.harmless ? kStopRecorder_s : kStop_s);
    }
  };
  Child* const bridge = child_named(kBridgeProgram);
  if (bridge != nullptr && request_.clock == "lockstep") wait_while_it_speaks(*bridge);
  stop_if([](const Child& child) { return child.planned.program == kBridgeProgram; });
  stop_if([](const Child& child) { return !child.end.harmless; });
  const bool recording = std::any_of(children_.begin(), children_.end(), [](const Child& child) {
    return child.end.harmless && !child.process->ended();
  });
  if (recording) usleep(200'000);  // facts L13b: the recorder ends at least this long after the last message
  stop_if([](const Child&) { return true; });
}

}  // namespace sprung
