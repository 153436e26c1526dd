#pragma once
/// What the processes of a run say of themselves, as it is shown: values and a time in, rows out. Pure.
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "signals/modes.h"
#include "sprung_msgs/process_status_t.hpp"

namespace sprung {

/// What the launcher itself knows of a process.
struct KnownProcess {
  std::string program;
  std::string host;  ///< where it should run; empty = here
  std::int64_t pid = 0;
  std::optional<int> exit_status;  ///< of one that has ended: 0..255, or 128 + signal
  int restarts = 0;
  bool speaks = true;  ///< publishes PROCESS_STATUS; lcm-logger does not
};

/// A line of the table. Numbers that nobody has told are NaN.
struct ProcessRow {
  std::string program;
  std::string host;
  std::string state;  ///< of PROCESS_STATUS, or "ended 1", "killed 9", "silent", "waited for"
  bool bad = false;   ///< ended or silent
  std::int64_t pid = 0;
  double cpu_percent = 0.0;  ///< of one core
  double memory_MB = 0.0;
  double rate_Hz = 0.0;
  double overruns = 0.0;
  double input_age_ms = 0.0;
  int restarts = 0;
  std::string detail;  ///< last refusal or complaint
};

class StatusBoard {
 public:
  static constexpr std::int64_t kSilent_us = 3'000'000;  ///< PROCESS_STATUS comes twice a second

  /// @return whether two processes of that name speak in turn: this one was heard before, and another since.
  bool hear(const sprung_msgs::process_status_t& status, std::int64_t now_us);
  /// Nobody listened until now (this process was stopped, or the machine stood still): nothing of that is
  /// silence.
  void begin_to_listen(std::int64_t now_us);
  void forget(const std::string& program);  ///< it starts again

  ProcessState state_of(const std::string& program) const;  ///< kStarting as long as nothing was heard
  const sprung_msgs::process_status_t* last(const std::string& program) const;
  /// Heard once, and then no more for kSilent_us.
  bool silent(const std::string& program, std::int64_t now_us) const;
  ProcessRow row(const KnownProcess& process, std::int64_t now_us) const;

 private:
  struct Heard {
    sprung_msgs::process_status_t status;
    std::int64_t at_us = 0;
    std::pair<std::string, std::int64_t> forerunner;  ///< host and pid of who spoke under that name before
  };
  std::map<std::string, Heard> heard_;
};

/// "exit status 1", or the signal's name.
std::string exit_text(int status);

}  // namespace sprung
