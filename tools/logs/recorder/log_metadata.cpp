#include "tools/logs/recorder/log_metadata.h"

#include <sprung_version.h>
#include <unistd.h>

#include "robots/overlay.h"
#include "runtime/process_options.h"

namespace sprung {

namespace {

std::string host_name() {
  char name[256] = {};
  return gethostname(name, sizeof name - 1) == 0 ? name : "unknown";
}

}  // namespace

sprung_msgs::log_metadata_t make_log_metadata(const RobotConfig& robot, const RecordedRun& run) {
  return make_log_metadata(robot, robot_text(robot.folder), run);
}

sprung_msgs::log_metadata_t make_log_metadata(const RobotConfig& robot, const std::string& robot_yaml,
                                              const RecordedRun& run) {
  sprung_msgs::log_metadata_t metadata{};
  metadata.session = run.session;
  metadata.utime = run.utime_us;
  metadata.seq = -1;
  metadata.utc_us = run.utc_us;
  metadata.configuration_hash = configuration_hash(robot, run.preset);
  metadata.simulation = run.simulation ? 1 : 0;
  metadata.version = SPRUNG_VERSION;
  metadata.git_hash = SPRUNG_GIT_HASH;
  metadata.robot = robot.name;
  metadata.preset = run.preset;
  metadata.clock = run.clock;
  metadata.host = host_name();
  metadata.command_line = run.command_line;
  metadata.lcm_url = run.lcm_url;
  metadata.robot_yaml = robot_yaml;
  return metadata;
}

}  // namespace sprung
