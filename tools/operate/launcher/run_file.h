#pragma once
/// The file by which `sprung jump` in a second terminal finds the robot that `sprung up` runs: one JSON file
/// an instance, in the folder of run_folder.h. Where that one cannot be trusted every function here throws.
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "runtime/message_key.h"
#include "runtime/node.h"

namespace sprung {

struct RunningProcess {
  std::string program;
  std::int64_t pid = 0;
};

struct RunInfo {
  std::string instance = "default";
  std::string robot;         ///< name
  std::string robot_folder;  ///< absolute
  std::string preset;
  std::string clock;  ///< realtime or lockstep
  bool simulation = false;
  std::vector<std::string> plant;  ///< KEY=VALUE of a simulation, as it was typed
  bool maintenance = false;
  std::int64_t session = 0;
  std::int64_t epoch_us = 0;  ///< CLOCK_MONOTONIC at the session's begin
  std::string lcm_url;
  std::string log;                 ///< LCM log being written, empty = none
  std::vector<std::string> can;    ///< BUS=ADDRESS where it is not robot.yaml's
  std::vector<std::string> buses;  ///< addresses of all that this launcher's bridge uses
  std::int64_t launcher_pid = 0;
  std::vector<RunningProcess> processes;
  std::string via;  ///< the computer that it runs on, where that is another one (tools/station/gateway)
};

/// As the file holds it. @throws nlohmann::json::exception on what is none.
std::string run_text(const RunInfo& info);
RunInfo parse_run(const std::string& text);

/// Nothing runs, or something that the command does not fit; what() says what to do next.
struct NotRunning : std::runtime_error {
  using std::runtime_error::runtime_error;
};

std::string run_file_path(const std::string& instance);
/// Of the run's key (runtime/key_source.h), which lives as long as the run.
std::string run_key_path(const std::string& instance);

/// How a command gets to a run that it commands: with its key. Who only looks needs none. @throws
/// std::runtime_error as read_key_file.
NodeOptions commanding(const RunInfo& info);

/// The right to be `sprung up` of an instance: a lock that the kernel releases when its holder ends, however
/// that happens. Its file holds the run's description for the others.
class RunFile {
 public:
  /// @throws std::runtime_error when another launcher holds the instance, naming its robot.
  explicit RunFile(const std::string& instance);
  ~RunFile();  ///< removes description and key that it wrote, then lets go; what a killed one left stays for
               ///< the next to see
  RunFile(const RunFile&) = delete;
  RunFile& operator=(const RunFile&) = delete;

  /// For the user's own commands. @throws std::runtime_error when it cannot be written.
  void write_key(const MessageKey& key);
  /// Written whole or not at all. @throws std::runtime_error when it cannot be written.
  void write(const RunInfo& info);

 private:
  std::string instance_;
  int lock_ = -1;
  bool written_ = false;
  bool key_written_ = false;
};

/// nullopt where nobody holds the instance, or its description is not there yet.
std::optional<RunInfo> read_run_file(const std::string& instance);
/// All that are up, as far as their descriptions are there; in the order of their instances' names.
std::vector<RunInfo> runs_that_are_up();
/// Processes that still run although their launcher is gone: it was killed, and they are about to end. @param
/// own_instance whose lock the caller has.
std::vector<RunningProcess> left_behind(const std::string& own_instance);
/// @param robot empty = any. @throws NotRunning when nothing runs as `instance` or another robot does.
RunInfo require_running(const std::string& instance, const std::string& robot);

}  // namespace sprung
