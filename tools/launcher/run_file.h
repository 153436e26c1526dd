#pragma once
/// The file by which `sprung jump` in a second terminal finds the robot that `sprung up` runs: one JSON file
/// an instance, in $SPRUNG_RUN_DIR, else $XDG_RUNTIME_DIR/sprung, else /tmp/sprung-UID.
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace sprung {

struct RunningProcess {
  std::string program;
  std::int64_t pid = 0;
};

struct RunInfo {
  std::string instance = "default";
  std::string robot;  ///< name
  std::string robot_folder;
  std::string preset;
  std::string clock;  ///< realtime or lockstep
  bool simulation = false;
  std::int64_t session = 0;
  std::int64_t epoch_us = 0;  ///< CLOCK_MONOTONIC at the session's begin
  std::string lcm_url;
  std::string log;  ///< LCM log being written, empty = none
  std::int64_t launcher_pid = 0;
  std::vector<RunningProcess> processes;
};

/// Nothing runs, or something that the command does not fit; what() says what to do next.
struct NotRunning : std::runtime_error {
  using std::runtime_error::runtime_error;
};

std::string run_file_path(const std::string& instance);
/// Written whole or not at all (rename).
void write_run_file(const RunInfo& info);
void remove_run_file(const std::string& instance);
/// nullopt where there is none, where it is unreadable, or where its launcher is gone (a stale file is
/// removed).
std::optional<RunInfo> read_run_file(const std::string& instance);
/// @param robot empty = any. @throws NotRunning when nothing runs as `instance` or another robot does.
RunInfo require_running(const std::string& instance, const std::string& robot);

}  // namespace sprung
