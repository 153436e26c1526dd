#include "tools/launcher/launcher.h"

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
#include "runtime/process_options.h"
#include "runtime/resource_use.h"
#include "runtime/stop_request.h"
#include "runtime/types_hash.h"
#include "tools/launcher/lead_finder.h"
#include "tools/launcher/recorder_plan.h"
#include "tools/launcher/run_conflict.h"

namespace sprung {

namespace {

constexpr double kStop_s = 3.0;                     // a bridge may damp its robot for half a second first
constexpr double kStopRecorder_s = 10.0;            // a disk that is slow must still get everything
constexpr std::int64_t kStoodStill_us = 1'000'000;  // a look comes many times a second

BuildIdentity own_identity(const LaunchRequest& request, const RobotConfig& robot) {
  return {SPRUNG_VERSION, SPRUNG_GIT_HASH, types_hash(), configuration_hash(robot, request.preset),
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

}  // namespace

Launcher::Launcher(const LaunchRequest& request, const RobotConfig& robot)
    : request_(request),
      robot_(robot),
      leads_(checked_leads(request, robot)),
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
  return std::make_unique<ChildProcess>(path, planned.arguments, Output::kCaptured);
}

void Launcher::start(const PlannedProcess& planned) {
  EndedProcess end;
  end.policy = planned.restart;
  end.lockstep = request_.clock == "lockstep";
  children_.push_back({planned, run_program(planned), {}, end, false});
  info_.processes.push_back({planned.program, children_.back().process->pid()});
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

Launcher::Child* Launcher::child_named(const std::string& program) {
  const auto is_it = [&](const Child& child) { return child.planned.program == program; };
  const auto found = std::find_if(children_.begin(), children_.end(), is_it);
  return found == children_.end() ? nullptr : &*found;
}

/// @param child of this launcher that says so; nullptr = another host's.
void Launcher::refuse_stranger(const sprung_msgs::process_status_t& status, Child* child) {
  const std::string why = why_not_together(identity_, status, mixed_builds_);
  if (why.empty()) return;
  if (named_.insert(status.process + status.host + std::to_string(status.pid)).second)
    trouble_.push_back(why);
  if (child == nullptr || state_ != ProcessState::kRunning) return;
  child->process->signal(SIGTERM);  // its program was built anew, or robot.yaml changed, since the run began
  child->end.restarts = RestartRule::kMost;
}

void Launcher::name_twice(const sprung_msgs::process_status_t& status) {
  if (!named_.insert("twice " + status.process).second) return;
  trouble_.push_back(status.process + " runs twice in this run, once as process " +
                     std::to_string(status.pid) + " on " + status.host +
                     ": one host too many was started with the same --host");
}

void Launcher::read_statuses() {
  while (auto status = statuses_.pop()) {
    if (status->process == kLauncherProgram && leads_) continue;  // its own
    Child* const child = child_named(status->process);
    const bool own = child != nullptr && status->pid == child->process->pid() && status->host == host_name_;
    refuse_stranger(*status, own ? child : nullptr);
    // Of this host it is the recorder of `sprung record`, or the last word of one that was started again.
    const bool second = child != nullptr && !own && !child->end.harmless && status->host != host_name_;
    if (child != nullptr && !own && !second) continue;
    if (second || board_.hear(*status, node_.utime_us())) name_twice(*status);
  }
  while (auto safety = safeties_.pop()) safety_ = std::move(*safety);
}

void Launcher::start_again_what_may() {
  bool waiting = false;
  for (Child& child : children_) {
    if (!child.reported || !child.process->ended() || !RestartRule::hopeful(child.end)) continue;
    waiting = waiting || !child.end.harmless;
    if (waiting && torque_watch_ == nullptr)
      torque_watch_ = std::make_unique<TorqueWatch>(
          NodeOptions{request_.lcm_url, info_.session, info_.epoch_us, {}}, robot_);
    const auto torque = torque_watch_ != nullptr ? torque_watch_->heard() : std::nullopt;
    if (RestartRule::due(child.end, torque, node_.utime_us())) start_again(child);
  }
  if (!waiting) torque_watch_.reset();
}

void Launcher::look() {
  const std::int64_t now_us = node_.utime_us();
  if (looked_us_ > 0 && now_us - looked_us_ > kStoodStill_us) board_.begin_to_listen(now_us);
  looked_us_ = now_us;
  read_statuses();
  start_again_what_may();
  for (Child& child : children_) read_lines(child);
  name_the_silent();
  publish_status();
  if (turn_) turn_();
}

void Launcher::name_the_silent() {
  const std::int64_t now_us = node_.utime_us();
  const auto name = [&](const std::string& program, const char* what) {
    if (board_.silent(program, now_us) && named_.insert(program).second) trouble_.push_back(program + what);
  };
  for (Child& child : children_) {
    if (!child.process->ended())
      name(child.planned.program, " runs but has said nothing for 3 s: see its last lines, then sprung down");
  }
  for (const RemoteProcess& remote : remote_)
    name(remote.program, " on another host has said nothing for 3 s: look there");
}

void Launcher::publish_status() {
  if (!leads_ || !schedule_.due(state_, node_.utime_us())) return;
  ProcessStatus status;
  status.stamp = {node_.utime_us(), -1};
  status.pid = getpid();
  status.utc_offset_us = node_.clock().utc_offset_us();
  status.configuration_hash = identity_.configuration_hash;
  status.types_hash = identity_.types_hash;
  status.state = state_;
  status.memory_kB = resident_kB();
  status.process = kLauncherProgram;
  status.host = host_name_;
  status.version = identity_.version;
  status.git_hash = identity_.git_hash;
  status.robot = identity_.robot;
  status.clock = identity_.clock;
  publisher_.publish(status);
}

void Launcher::wait_for(const std::string& program, ProcessState state) {
  const std::int64_t end_us = node_.utime_us() + std::llround(request_.patience_s * 1e6);
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
  std::string text =
      program + " is not " + name(state) + " after " + std::to_string(request_.patience_s) + " s";
  for (const RemoteProcess& remote : remote_) {
    if (remote.program != program) continue;
    text += "; start it there: sprung up " + request_.robot +
            (remote.host.empty() ? "" : " --host " + remote.host) +
            ", with an --lcm-url whose ttl is 1 on every host";
  }
  if (status != nullptr && !status->detail.empty()) text += ": " + status->detail;
  const std::string refusal = node_.last_refusal();
  return refusal.empty() ? text : text + " (" + refusal + ")";
}

void Launcher::refuse_trouble() {
  for (const Ended& ended : newly_ended()) {
    throw std::runtime_error(ended.program + " ended while starting: " + exit_text(ended.status));
  }
  if (!trouble_.empty()) throw std::runtime_error(trouble_.front());
}

std::vector<Launcher::Ended> Launcher::newly_ended() {
  std::vector<Ended> ended;
  for (Child& child : children_) {
    if (child.reported || !child.process->ended()) continue;
    read_lines(child);
    child.reported = true;
    child.end.ended_utime_us = node_.utime_us();
    child.end.by_signal = *child.process->ended() >= 128;
    ended.push_back({child.planned.program, *child.process->ended(), RestartRule::hopeful(child.end)});
  }
  return ended;
}

std::vector<std::string> Launcher::new_trouble() { return std::exchange(trouble_, {}); }

bool Launcher::lead_is_gone() const {
  if (leads_) return false;
  return board_.state_of(kLauncherProgram) == ProcessState::kStopping ||
         board_.silent(kLauncherProgram, node_.utime_us());
}

std::size_t Launcher::running() const {
  const auto runs = [](const Child& child) { return !child.process->ended(); };
  return static_cast<std::size_t>(std::count_if(children_.begin(), children_.end(), runs));
}

std::vector<ProcessRow> Launcher::rows() const {
  std::vector<ProcessRow> rows;
  for (const Child& child : children_) {
    const KnownProcess known{child.planned.program, "",
                             child.process->pid(),  child.process->ended(),
                             child.end.restarts,    says_status(child.planned)};
    rows.push_back(board_.row(known, node_.utime_us()));
  }
  for (const RemoteProcess& remote : remote_) {
    const std::string host = remote.host.empty() ? "(has the bridge)" : remote.host;
    rows.push_back(board_.row({remote.program, host, 0, std::nullopt, 0, true}, node_.utime_us()));
  }
  return rows;
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

void Launcher::stop_one(Child& child, double patience_s) {
  if (!child.process->ended() && child.process->stop(patience_s) == 128 + SIGKILL) {
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
  stop_if([](const Child& child) { return child.planned.program == kBridgeProgram; });
  stop_if([](const Child& child) { return !child.end.harmless; });
  const bool recording = std::any_of(children_.begin(), children_.end(), [](const Child& child) {
    return child.end.harmless && !child.process->ended();
  });
  if (recording) usleep(200'000);  // facts L13b: the recorder ends at least this long after the last message
  stop_if([](const Child&) { return true; });
}

}  // namespace sprung
