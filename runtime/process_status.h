#pragma once
/// What a process says of itself on PROCESS_STATUS, and when it is due: on a change of state and twice a
/// second.
#include <cstdint>
#include <string>

#include "runtime/loop_statistics.h"
#include "signals/messages.h"
#include "signals/modes.h"
#include "signals/stamp.h"
#include "signals/vec3.h"
#include "sprung_msgs/process_status_t.hpp"

namespace sprung {

struct ProcessStatus {
  Stamp stamp;
  std::int64_t pid = 0;
  std::int64_t utc_offset_us = 0;
  std::int64_t configuration_hash = 0;
  ProcessState state = ProcessState::kStarting;
  std::int64_t cycles = 0;
  std::int64_t refused_messages = 0;
  std::int64_t sequence_gaps = 0;
  LoopSummary loop;            ///< periods, compute times, overruns
  double input_age_us = kNaN;  ///< of the newest input, at use
  std::int64_t types_hash = 0;
  double cpu_share = 0.0;      ///< of one core since the last status, all threads
  std::int64_t memory_kB = 0;  ///< resident
  std::string process;
  std::string host;
  std::string version;
  std::string git_hash;
  std::string robot;
  std::string clock;      ///< lockstep or realtime
  std::string real_time;  ///< what the scheduler granted
  std::string detail;     ///< last refusal or complaint
};

void to_message(const ProcessStatus& in, std::int64_t session, sprung_msgs::process_status_t& out);
[[nodiscard]] Reading from_message(const sprung_msgs::process_status_t& in, ProcessStatus& out);

template <>
struct MessageOfSignal<ProcessStatus> {
  using Type = sprung_msgs::process_status_t;
};

/// A standing note is said with every detail: none hides it. @return the detail, and behind it the note where
/// it is not in it already.
std::string with_note(const std::string& detail, const std::string& note);

/// When to publish. Pure.
class StatusSchedule {
 public:
  static constexpr std::int64_t kInterval_us = 500'000;
  bool due(ProcessState state, std::int64_t now_us) noexcept;  ///< true counts as published

 private:
  ProcessState last_state_ = ProcessState::kStarting;
  std::int64_t next_us_ = 0;
  bool any_ = false;
};

}  // namespace sprung
