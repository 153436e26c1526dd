#pragma once
/// `sprung replay LOG --into CORES`: a log through the cores as fast as it goes. Reads files, and writes one
/// where asked.
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "robots/robot_config.h"
#include "sprung_msgs/log_metadata_t.hpp"
#include "tools/logs/replay/core_replay.h"
#include "tools/logs/replay/difference_table.h"
#include "tools/logs/replay/lockstep_cycles.h"

namespace sprung {

/// What a log is of: robot, preset and clock, from LOG_METADATA, or from what PROCESS_STATUS says where
/// lcm-logger made the log. Reads files.
struct LoggedRun {
  std::optional<sprung_msgs::log_metadata_t> metadata;
  std::string robot;                    ///< name; empty where the log does not say
  std::string clock;                    ///< lockstep, realtime or inprocess; empty where the log does not say
  std::int64_t configuration_hash = 0;  ///< as in PROCESS_STATUS
};

/// Looks at the beginning of the log only. @throws std::runtime_error where it cannot be read.
LoggedRun read_logged_run(const std::string& path);

/// With what a log is replayed.
struct ReplayRobot {
  RobotConfig robot;
  std::string preset;
  std::string robot_yaml;  ///< the text that `robot` was read from
  WatchdogConfig watchdogs;
  std::string source;  ///< for people: where robot and preset come from
};

/// @param robot folder, name or robot.yaml that takes the place of the log's own; empty = the log's own, as
/// LOG_METADATA holds it.
/// @param preset takes the place of the log's own; empty = the log's own, or the one of the hash in
/// PROCESS_STATUS.
/// @throws std::runtime_error saying what to add to the command, ConfigError on a bad robot file.
ReplayRobot replay_robot(const LoggedRun& run, const std::string& robot, const std::string& preset);

struct ReplayRequest {
  std::string log;
  std::string robot;   ///< folder, name or robot.yaml instead of the log's own; empty = the log's own
  std::string preset;  ///< instead of the log's own; empty = the log's own
  CoreChoice cores;
  /// Robot's time since the begin of the log: what is earlier runs, but is not compared.
  double from_s = 0.0;
  double to_s = std::numeric_limits<double>::infinity();  ///< the replay ends there
  std::string out;                                        ///< LCM log of what the cores say now; empty = none
  bool courses = false;  ///< keep the course of each field's difference, for plots
};

struct ReplayResult {
  ReplayCounts counts;
  LogFlaws flaws;
  LockstepFlaws lockstep;  ///< of the cycles that are compared; none where the clock lets messages be late
  DifferenceTable differences;
  std::string source;                 ///< of robot and preset
  std::string robot;                  ///< name
  std::string clock;                  ///< of the log; may be empty
  std::string version;                ///< and git hash of what made it; empty where the log does not say
  std::int64_t last_logged_seq = -1;  ///< cycle with which the log ends
  double replayed_s = 0.0;            ///< robot's time
  double wall_s = 0.0;
  double processor_s = 0.0;   ///< of this process meanwhile: on a busy machine less than the wall time
  std::uint64_t damages = 0;  ///< of the file

  /// All was compared, all of it is the same, and neither input nor message was missing. In real time
  /// messages may be.
  bool identical() const noexcept;
  /// Nothing in the log says that its run went on by wall time.
  bool deterministic() const noexcept { return lockstep.deterministic() && flaws.said.empty(); }
  double times_real_time() const noexcept { return wall_s > 0.0 ? replayed_s / wall_s : 0.0; }
};

/// Told now and then how many bytes of how many are done.
using ReplayProgress = std::function<void(std::uint64_t done, std::uint64_t all)>;

/// @throws std::runtime_error where the log, or the robot, does not fit; std::invalid_argument where `out` is
/// the log itself.
ReplayResult run_replay(const ReplayRequest& request, const ReplayProgress& progress = {});

}  // namespace sprung
