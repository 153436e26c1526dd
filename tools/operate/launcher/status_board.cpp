#include "tools/operate/launcher/status_board.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace sprung {
namespace {

constexpr double kNotTold = std::numeric_limits<double>::quiet_NaN();

ProcessRow silent_row(const KnownProcess& process) {
  ProcessRow row;
  row.program = process.program;
  row.host = process.host;
  row.pid = process.pid;
  row.restarts = process.restarts;
  row.cpu_percent = row.memory_MB = row.rate_Hz = row.overruns = row.input_age_ms = kNotTold;
  return row;
}

void tell(ProcessRow& row, const sprung_msgs::process_status_t& status) {
  row.state = name(static_cast<ProcessState>(status.state));
  row.host = status.host;
  row.pid = status.pid;
  row.cpu_percent = 100.0 * status.cpu_share;
  row.memory_MB = static_cast<double>(status.memory_kB) / 1024.0;
  row.rate_Hz = status.loop_period_us > 0.0 ? 1e6 / status.loop_period_us : kNotTold;
  row.overruns = static_cast<double>(status.overruns);
  row.input_age_ms = status.input_age_us * 1e-3;
  row.detail = status.detail;
}

}  // namespace

std::string exit_text(int status) {
  return status < 128 ? "exit status " + std::to_string(status) : std::string(strsignal(status - 128));
}

bool StatusBoard::hear(const sprung_msgs::process_status_t& status, std::int64_t now_us) {
  Heard& heard = heard_[status.process];
  const std::pair<std::string, std::int64_t> before{heard.status.host, heard.status.pid},
      now{status.host, status.pid};
  const bool in_turn = now != before && now == heard.forerunner;
  if (now != before) heard.forerunner = before;
  heard.status = status;
  heard.at_us = now_us;
  return in_turn;
}

void StatusBoard::begin_to_listen(std::int64_t now_us) {
  for (auto& [program, heard] : heard_) heard.at_us = std::max(heard.at_us, now_us);
}

void StatusBoard::forget(const std::string& program) { heard_.erase(program); }

const sprung_msgs::process_status_t* StatusBoard::last(const std::string& program) const {
  const auto found = heard_.find(program);
  return found == heard_.end() ? nullptr : &found->second.status;
}

ProcessState StatusBoard::state_of(const std::string& program) const {
  const auto* const status = last(program);
  return status == nullptr ? ProcessState::kStarting : static_cast<ProcessState>(status->state);
}

bool StatusBoard::silent(const std::string& program, std::int64_t now_us) const {
  const auto found = heard_.find(program);
  return found != heard_.end() && now_us - found->second.at_us > kSilent_us;
}

ProcessRow StatusBoard::row(const KnownProcess& process, std::int64_t now_us) const {
  ProcessRow row = silent_row(process);
  if (const auto* const status = last(process.program)) {
    tell(row, *status);
    row.bad = silent(process.program, now_us);
    if (row.bad) row.state = "silent";
  } else {
    row.state = process.speaks ? (process.host.empty() ? "starting" : "waited for") : "running";
  }
  if (process.exit_status) {
    const int status = *process.exit_status;
    row.bad = true;
    row.state = status < 128 ? "ended " + std::to_string(status) : "killed " + std::to_string(status - 128);
  }
  return row;
}

}  // namespace sprung
