#include "tools/replay/replay_run.h"

#include <chrono>
#include <cmath>
#include <ctime>
#include <optional>

#include "tools/log/reader.h"
#include "tools/log/timeline.h"
#include "tools/log/writer.h"

namespace sprung {

namespace {

constexpr std::int64_t kProgressEvents = 20'000;

/// Differences of the span that is looked at.
class Findings {
 public:
  Findings(const ReplayRequest& request, DifferenceTable& table) : request_(request), table_(table) {}
  void add(const MessagePair& pair) {
    if (pair.time_s < request_.from_s) return;
    table_.add(pair.channel, pair.seq, pair.time_s, comparison_.compare(pair.recorded, pair.replayed));
  }

 private:
  const ReplayRequest& request_;
  DifferenceTable& table_;
  MessageComparison comparison_;
};

}  // namespace

bool ReplayResult::identical() const noexcept {
  return counts.compared > 0 && !differences.first() && counts.incomplete == 0;
}

ReplayResult run_replay(const ReplayRequest& request, const ReplayProgress& progress) {
  const LoggedRun run = read_logged_run(request.log);
  const ReplayRobot with = replay_robot(run, request.robot, request.preset);
  ReplayResult result;
  result.differences = DifferenceTable(request.courses);
  result.source = with.source;
  result.robot = with.robot.name;
  result.clock = run.clock;
  CoreReplay replay(with.robot, with.preset, with.watchdogs, request.cores);
  Findings findings(request, result.differences);
  replay.on_difference([&](const MessagePair& pair) { findings.add(pair); });
  std::optional<log::Writer> out;
  if (!request.out.empty()) out.emplace(request.out);
  if (out)
    replay.on_output([&](const MessagePair& pair) {
      out->write(pair.time_us, pair.channel, pair.replayed.data(), pair.replayed.size());
    });
  double first_s = std::numeric_limits<double>::quiet_NaN(), last_s = first_s;
  LogCycles cycles([&](const LoggedCycle& cycle) {
    if (cycle.time_s > request.to_s) return;
    if (std::isnan(first_s)) first_s = cycle.time_s;
    last_s = cycle.time_s;
    result.last_logged_seq = cycle.seq;
    replay.step(cycle);
  });

  const auto started = std::chrono::steady_clock::now();
  const std::clock_t processor_started = std::clock();
  log::Reader reader(request.log);
  log::Timeline timeline;
  std::int64_t events = 0;
  for (log::Event event; reader.next(event);) {
    if (progress && ++events % kProgressEvents == 0) progress(reader.position(), reader.file_bytes());
    const bool first = timeline.begin_us() == 0;
    if (!first && !LogCycles::uses(event.channel)) continue;
    cycles.add(event, timeline.next(event).time_s);
  }
  cycles.finish();
  if (out) out->close();
  result.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  result.processor_s = static_cast<double>(std::clock() - processor_started) / CLOCKS_PER_SEC;
  result.replayed_s = std::isnan(first_s) ? 0.0 : last_s - first_s;
  result.counts = replay.counts();
  result.flaws = cycles.flaws();
  result.damages = reader.damage_count();
  return result;
}

}  // namespace sprung
