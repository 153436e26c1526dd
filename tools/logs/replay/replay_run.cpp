#include "tools/logs/replay/replay_run.h"

#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <optional>
#include <stdexcept>

#include "lcmtypes/channels.h"
#include "robots/maintenance.h"
#include "robots/robot_loader.h"
#include "runtime/message_layout.h"
#include "runtime/process_options.h"
#include "runtime/receive_guard.h"
#include "tools/logs/log/reader.h"
#include "tools/logs/log/rewrite.h"
#include "tools/logs/log/writer.h"
#include "tools/logs/recorder/log_messages.h"
#include "tools/logs/recorder/log_metadata.h"
#include "tools/logs/replay/cycle_feed.h"

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

/// Whether each process waits for the others, so that each cycle has each message, as `sprung log verify` has
/// it.
bool waits_for_all(const std::string& clock) { return clock == "lockstep" || clock == "inprocess"; }

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

/// The log of what the cores say now. Begins with LOG_METADATA, as every log does: of the robot that they
/// have.
class OutputLog {
 public:
  /// @throws std::invalid_argument where it would take the place of the log that is read.
  OutputLog(const ReplayRequest& request, const LoggedRun& run, const ReplayRobot& with)
      : writer_(other_file(request)), with_(with) {
    run_.preset = with.preset;
    run_.clock = run.clock;
    run_.simulation = run.metadata && run.metadata->simulation != 0;
    run_.command_line = "sprung replay " + request.log + " --into " + names(request.cores) + " --out " +
                        request.out;
    if (!request.robot.empty()) run_.command_line += " --robot " + request.robot;
    if (!request.preset.empty()) run_.command_line += " --preset " + request.preset;
  }
  void add(const MessagePair& pair) {
    if (writer_.events() == 0) write_metadata(pair);
    writer_.write(pair.time_us, pair.channel, pair.replayed.data(), pair.replayed.size());
  }
  void close() { writer_.close(); }

 private:
  static const std::string& other_file(const ReplayRequest& request) {
    log::refuse_same_file({request.log}, request.out);
    return request.out;
  }
  static std::string names(const CoreChoice& cores) {
    std::string out;
    for (const Core core : {Core::kEstimator, Core::kPlanner, Core::kController})
      if (cores[core]) out += (out.empty() ? "" : ",") + std::string(name(core));
    return out;
  }
  void write_metadata(const MessagePair& first) {
    run_.session = read_int64(first.replayed.data(), kSessionOffset);
    run_.utc_us = first.time_us;
    const std::vector<std::uint8_t> bytes = message_bytes(
        make_log_metadata(with_.robot, with_.robot_yaml, run_));
    writer_.write(first.time_us, channels::kLogMetadata, bytes.data(), bytes.size());
  }

  log::Writer writer_;
  const ReplayRobot& with_;
  RecordedRun run_;
};

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

bool ReplayResult::identical() const noexcept {
  return counts.compared > 0 && !differences.first() && counts.incomplete == 0 && counts.other_version == 0 &&
         lockstep.every_message();
}

ReplayResult run_replay(const ReplayRequest& request, const ReplayProgress& progress) {
  const LoggedRun run = read_logged_run(request.log);
  const ReplayRobot with = replay_robot(run, request.robot, request.preset);
  ReplayResult result;
  result.differences = DifferenceTable(request.courses);
  result.source = with.source;
  result.robot = with.robot.name;
  result.clock = run.clock;
  if (run.metadata) result.version = run.metadata->version + " " + run.metadata->git_hash;
  EstimatorReplay estimator(with.robot, with.preset, with.watchdogs, request.cores[Core::kEstimator]);
  CoreReplay replay(with.robot, with.preset, with.watchdogs, request.cores);
  replay.compare_from(request.from_s);
  MessageComparison comparison;
  replay.on_difference([&](const MessagePair& pair) {
    result.differences.add(pair.channel, pair.seq, pair.time_s,
                           comparison.compare(pair.recorded, pair.replayed));
  });
  std::optional<OutputLog> out;
  if (!request.out.empty()) out.emplace(request, run, with);
  if (out) replay.on_output([&](const MessagePair& pair) { out->add(pair); });
  double first_s = std::numeric_limits<double>::quiet_NaN(), last_s = first_s;

  const auto started = std::chrono::steady_clock::now();
  const std::clock_t processor_started = std::clock();
  const bool all_wait = waits_for_all(run.clock);
  LockstepCycles lockstep;
  CycleFeed feed(request.log, request.to_s, with.robot, estimator);
  while (CycleBatch* const batch = feed.next()) {
    for (std::size_t i = 0; i < batch->count; ++i) {
      auto& [cycle, estimated] = batch->cycles[i];
      if (std::isnan(first_s)) first_s = cycle.time_s;
      last_s = cycle.time_s;
      result.last_logged_seq = cycle.seq;
      if (all_wait && cycle.time_s >= request.from_s) lockstep.add(cycle);
      replay.step(cycle, estimated);
    }
    if (progress && batch->position) progress(*batch->position, feed.file_bytes());
  }
  if (out) out->close();
  result.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  result.processor_s = static_cast<double>(std::clock() - processor_started) / CLOCKS_PER_SEC;
  result.replayed_s = std::isnan(first_s) ? 0.0 : last_s - first_s;
  result.counts = replay.counts();
  result.flaws = feed.flaws();
  result.lockstep = lockstep.flaws();
  result.damages = feed.damage_count();
  return result;
}

}  // namespace sprung
