#pragma once
/// What LOG_METADATA says of a run. Reads robot.yaml and the machine's name.
#include <cstdint>
#include <string>

#include "robots/robot_config.h"
#include "sprung_msgs/log_metadata_t.hpp"

namespace sprung {

struct RecordedRun {
  std::string preset;
  std::string clock;  ///< lockstep, realtime or inprocess
  bool simulation = false;
  std::int64_t session = 0;
  std::int64_t utime_us = 0;  ///< now, on the session's clock
  std::int64_t utc_us = 0;    ///< now
  std::string command_line;
  std::string lcm_url;  ///< empty: there was no network
};

/// @throws std::runtime_error when the robot's file cannot be read any more.
sprung_msgs::log_metadata_t make_log_metadata(const RobotConfig& robot, const RecordedRun& run);
/// The same where the text of robot.yaml is known already.
sprung_msgs::log_metadata_t make_log_metadata(const RobotConfig& robot, const std::string& robot_yaml,
                                              const RecordedRun& run);

}  // namespace sprung
