#include "tools/logs/replay/logged_run.h"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "lcmtypes/channels.h"
#include "robots/maintenance.h"
#include "robots/robot_loader.h"
#include "runtime/process_options.h"
#include "runtime/receive_guard.h"
#include "tools/logs/log/reader.h"
#include "tools/logs/recorder/log_messages.h"

namespace sprung {

namespace {

namespace fs = std::filesystem;

/// PROCESS_STATUS comes twice a second from each process: by then all have spoken.
constexpr std::int64_t kLookedAt_us = 5'000'000;

std::optional<sprung_msgs::process_status_t> read_status(const log::Event& event) {
  ReceiveGuard guard(channels::kProcessStatus, layout_of<sprung_msgs::process_status_t>(),
                     CountLimits::none(), 0);
  sprung_msgs::process_status_t status;
  if (guard.decode(event.data, event.size, status) != Refusal::kNone) return std::nullopt;
  return status;
}

std::string text_of(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read " + path);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

bool has_word(const std::string& text, const std::string& word) {
  return (' ' + text + ' ').find(' ' + word + ' ') != std::string::npos;
}

/// Sets robot and robot_yaml.
void choose_robot(const LoggedRun& run, const std::string& robot, ReplayRobot& out) {
  const bool is_file = !robot.empty() && fs::is_regular_file(robot);
  if (robot.empty() && !run.metadata && run.robot.empty())
    throw std::runtime_error("the log does not say of which robot it is: add --robot NAME");
  if (is_file || (robot.empty() && run.metadata)) {
    out.robot_yaml = is_file ? text_of(robot) : run.metadata->robot_yaml;
    out.robot = read_robot_text(out.robot_yaml, is_file ? robot : "robot.yaml in the log");
  } else {
    out.robot = load_robot(robot.empty() ? run.robot : robot);
    out.robot_yaml = text_of(out.robot.folder + "/robot.yaml");
  }
  if (run.metadata && has_word(run.metadata->command_line, "--maintenance"))
    out.robot = for_maintenance(std::move(out.robot));
}

/// lcm-logger's logs hold no preset, but every process says the hash of robot.yaml and preset.
std::string preset_by_hash(const LoggedRun& run, const RobotConfig& robot, const std::string& file) {
  for (const PresetConfig& preset : robot.presets) {
    if (configuration_hash(robot, preset.name) == run.configuration_hash) return preset.name;
  }
  throw std::runtime_error("the log was made with another robot.yaml than " + file +
                           ": add --robot FILE that it was made with, or --preset NAME");
}

}  // namespace

LoggedRun read_logged_run(const std::string& path) {
  LoggedRun run;
  log::Reader reader(path);
  std::int64_t first_us = 0;
  for (log::Event event; reader.next(event);) {
    if (first_us == 0) first_us = event.time_us;
    if (event.channel == channels::kLogMetadata) run.metadata = read_log_metadata(event.data, event.size);
    if (run.metadata) {
      run.robot = run.metadata->robot;
      run.clock = run.metadata->clock;
      run.configuration_hash = run.metadata->configuration_hash;
      return run;
    }
    if (event.channel == channels::kProcessStatus) {
      if (const auto status = read_status(event); status && status->configuration_hash != 0) {
        run.robot = status->robot;
        run.clock = status->clock;
        run.configuration_hash = status->configuration_hash;
      }
    }
    if (event.time_us - first_us > kLookedAt_us) break;
  }
  return run;
}

ReplayRobot replay_robot(const LoggedRun& run, const std::string& robot, const std::string& preset) {
  ReplayRobot out;
  choose_robot(run, robot, out);
  const std::string file = out.robot.folder.empty() ? robot : out.robot.folder + "/robot.yaml";
  out.preset = !preset.empty() ? preset
               : run.metadata  ? run.metadata->preset
                               : preset_by_hash(run, out.robot, file);
  (void)out.robot.preset(out.preset);
  // A log of lcm-logger does not say whether the drives were simulated. In real time they nearly always are
  // where that matters.
  const bool simulated = run.metadata ? run.metadata->simulation != 0 : true;
  out.watchdogs = simulated && run.clock == "realtime" ? out.robot.simulation_watchdogs : out.robot.watchdogs;
  out.source = (!robot.empty() ? robot
                : run.metadata ? "robot.yaml in the log"
                               : file) +
               ", preset " + out.preset;
  return out;
}

}  // namespace sprung
