#include "runtime/process_status.h"

#include "signals/message_fields.h"

namespace sprung {
namespace {

const auto kProcessStatus = [](auto& way, auto& m, auto& s) {
  fields::stamp(way, m, s);
  way(m.pid, s.pid);
  way(m.utc_offset_us, s.utc_offset_us);
  way(m.configuration_hash, s.configuration_hash);
  way(m.state, s.state);
  way(m.cycles, s.cycles);
  way(m.overruns, s.loop.overruns);
  way(m.refused_messages, s.refused_messages);
  way(m.sequence_gaps, s.sequence_gaps);
  way(m.loop_period_us, s.loop.period_median_us);
  way(m.loop_period_max_us, s.loop.period_max_us);
  way(m.compute_us, s.loop.compute_median_us);
  way(m.compute_max_us, s.loop.compute_max_us);
  way(m.input_age_us, s.input_age_us);
  way(m.types_hash, s.types_hash);
  way(m.cpu_share, s.cpu_share);
  way(m.memory_kB, s.memory_kB);
  way(m.process, s.process);
  way(m.host, s.host);
  way(m.version, s.version);
  way(m.git_hash, s.git_hash);
  way(m.robot, s.robot);
  way(m.clock, s.clock);
  way(m.real_time, s.real_time);
  way(m.detail, s.detail);
};

}  // namespace

void to_message(const ProcessStatus& in, std::int64_t session, sprung_msgs::process_status_t& out) {
  fields::write(kProcessStatus, in, session, out);
}

Reading from_message(const sprung_msgs::process_status_t& in, ProcessStatus& out) {
  return fields::read(kProcessStatus, in, out);
}

std::string with_note(const std::string& detail, const std::string& note) {
  if (note.empty() || detail.find(note) != std::string::npos) return detail;
  return detail.empty() ? note : detail + "; " + note;
}

bool StatusSchedule::due(ProcessState state, std::int64_t now_us) noexcept {
  if (any_ && state == last_state_ && now_us < next_us_) return false;
  any_ = true;
  last_state_ = state;
  next_us_ = now_us + kInterval_us;
  return true;
}

}  // namespace sprung
