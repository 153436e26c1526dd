/// The launcher's watch over its processes: what they say, what ended, what is wrong.
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <utility>

#include "runtime/resource_use.h"
#include "signals/own_inputs.h"
#include "tools/operate/launcher/launcher.h"
#include "tools/operate/launcher/lead_finder.h"
#include "tools/operate/launcher/record_command.h"
#include "tools/operate/launcher/recorder_plan.h"

namespace sprung {

namespace {

constexpr std::int64_t kStoodStill_us = 1'000'000;  // a look comes many times a second

}  // namespace

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

/// Each once: what is identified is of another day than this one, and no fault of the run.
void Launcher::name_misfit(const sprung_msgs::process_status_t& status) {
  const std::size_t begin = status.detail.find(kMisfitNote);  // behind what else the detail says
  if (begin == std::string::npos) return;
  const std::string note = status.detail.substr(begin);
  if (named_.insert(note).second) say("note: " + note + "; repeat: " + recordings_to_repeat(robot_, note));
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
    name_misfit(*status);
  }
  while (auto safety = safeties_.pop()) safety_ = std::move(*safety);
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

}  // namespace sprung
