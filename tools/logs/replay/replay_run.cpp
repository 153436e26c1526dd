#include "tools/logs/replay/replay_run.h"

#include <chrono>
#include <cmath>
#include <ctime>
#include <optional>

#include "lcmtypes/channels.h"
#include "runtime/message_layout.h"
#include "tools/logs/log/rewrite.h"
#include "tools/logs/log/writer.h"
#include "tools/logs/recorder/log_messages.h"
#include "tools/logs/recorder/log_metadata.h"
#include "tools/logs/replay/cycle_feed.h"

namespace sprung {

namespace {

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

bool ReplayResult::identical() const noexcept {
  return counts.compared > 0 && !differences.first() && counts.incomplete == 0 && counts.other_version == 0;
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
  CycleFeed feed(request.log, request.to_s, with.robot, estimator);
  while (CycleBatch* const batch = feed.next()) {
    for (std::size_t i = 0; i < batch->count; ++i) {
      auto& [cycle, estimated] = batch->cycles[i];
      if (std::isnan(first_s)) first_s = cycle.time_s;
      last_s = cycle.time_s;
      result.last_logged_seq = cycle.seq;
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
  result.damages = feed.damage_count();
  return result;
}

}  // namespace sprung
