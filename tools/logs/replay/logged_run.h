#pragma once
/// What a log is of: robot, preset and clock, from LOG_METADATA, or from what PROCESS_STATUS says where
/// lcm-logger made the log. Reads files.
#include <optional>
#include <string>

#include "robots/robot_config.h"
#include "sprung_msgs/log_metadata_t.hpp"

namespace sprung {

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

}  // namespace sprung
