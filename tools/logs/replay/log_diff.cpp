#include "tools/logs/replay/log_diff.h"

#include <algorithm>
#include <optional>

#include "runtime/message_layout.h"
#include "tools/logs/log/channel_filter.h"
#include "tools/logs/log/reader.h"
#include "tools/logs/log/timeline.h"
#include "tools/logs/recorder/gap_tracker.h"

namespace sprung {

namespace {

constexpr std::int64_t kDiffProgressEvents = 20'000;

/// One message that may have its like in the other log.
struct Candidate {
  std::string_view channel;
  std::int64_t key = 0;  ///< its cycle, or its number on the channel
  double time_s = 0.0;
  log::Event event;
};

/// The messages of one log that are compared, one by one.
class Side {
 public:
  Side(const std::string& path, const DiffRequest& request)
      : request_(request), reader_(path), filter_(request.channels) {}

  /// @return false at the end.
  bool next(Candidate& out) {
    while (reader_.next(out.event)) {
      const log::Timeline::Moment moment = timeline_.next(out.event);
      time_s_ = moment.time_s;
      const bool cyclic = has_every_cycle(out.event.channel);
      const bool wanted = request_.channels.empty() ? cyclic : filter_.keeps(out.event.channel);
      if (!wanted || !takes(out, moment, cyclic)) continue;
      out.channel = out.event.channel;
      out.time_s = moment.time_s;
      if (out.time_s >= request_.from_s && out.time_s <= request_.to_s) return true;
    }
    ended_ = true;
    return false;
  }

  bool ended() const noexcept { return ended_; }
  double time_s() const noexcept { return time_s_; }
  std::uint64_t position() const noexcept { return reader_.position(); }
  std::uint64_t file_bytes() const noexcept { return reader_.file_bytes(); }

 private:
  /// @return false for a repeat, or a message before cycle 0.
  bool takes(Candidate& out, const log::Timeline::Moment& moment, bool cyclic) {
    const std::string channel(out.event.channel);
    if (!cyclic || !moment.stamp) {
      out.key = numbers_[channel]++;
      return true;
    }
    GapTracker& cycles = cycles_[channel];
    const std::int64_t repeats = cycles.counts().repeats;
    cycles.add(moment.stamp->seq);
    out.key = moment.stamp->seq;
    return out.key >= 0 && cycles.counts().repeats == repeats;
  }

  const DiffRequest& request_;
  log::Reader reader_;
  log::Timeline timeline_;
  log::ChannelFilter filter_;
  std::map<std::string, std::int64_t> numbers_;
  std::map<std::string, GapTracker> cycles_;
  double time_s_ = 0.0;
  bool ended_ = false;
};

bool is_time(const FieldDifference& field) {
  constexpr std::string_view kEnding = "utime";
  return field.path.size() >= kEnding.size() &&
         field.path.compare(field.path.size() - kEnding.size(), kEnding.size(), kEnding) == 0;
}

/// Messages that wait for their like.
class Matcher {
 public:
  explicit Matcher(DiffResult& result) : result_(result) {}

  /// @param side 0 or 1. @param other_ended nothing more will come of the other log.
  void add(const Candidate& candidate, int side, bool other_ended) {
    const std::string channel(candidate.channel);
    Waiting& others = waiting_[1 - side][channel];
    Bytes bytes(candidate.event.data, candidate.event.data + candidate.event.size);
    const auto other = others.find(candidate.key);
    if (other != others.end()) {
      side == 0 ? compare(channel, candidate, bytes, other->second)
                : compare(channel, candidate, other->second, bytes);
      others.erase(other);
    } else if (other_ended) {
      alone(channel, side) += 1;
    } else {
      wait(channel, side, candidate.key, std::move(bytes));
    }
    // This side has gone past those: their like will not come.
    for (; !others.empty() && others.begin()->first < candidate.key - kLatest; others.erase(others.begin()))
      alone(channel, 1 - side) += 1;
  }

  void finish() {
    for (const int side : {0, 1}) {
      for (const auto& [channel, messages] : waiting_[side])
        alone(channel, side) += static_cast<std::int64_t>(messages.size());
    }
  }

 private:
  using Waiting = std::map<std::int64_t, Bytes>;  // by cycle, or number
  static constexpr std::int64_t kLatest = 1024;   // cycles by which messages of one log may be out of order

  std::int64_t& alone(const std::string& channel, int side) {
    ChannelDiff& counts = result_.channels[channel];
    return side == 0 ? counts.only_first : counts.only_second;
  }

  void wait(const std::string& channel, int side, std::int64_t key, Bytes&& bytes) {
    Waiting& waiting = waiting_[side][channel];
    waiting.emplace(key, std::move(bytes));
    result_.most_waiting = std::max(result_.most_waiting, waiting.size());
  }

  void compare(const std::string& channel, const Candidate& at, const Bytes& first, const Bytes& second) {
    ChannelDiff& counts = result_.channels[channel];
    ++counts.in_both;
    if (first == second) return;
    std::vector<FieldDifference> fields = comparison_.compare(first, second);
    fields.erase(std::remove_if(fields.begin(), fields.end(), is_time), fields.end());
    if (fields.empty()) return;
    ++counts.differing;
    result_.differences.add(channel, at.key, at.time_s, fields);
  }

  DiffResult& result_;
  MessageComparison comparison_;
  std::map<std::string, Waiting> waiting_[2];
};

std::string without_metadata(const LoggedRun& first, const LoggedRun& second) {
  const char* const which = first.metadata    ? "the second log"
                            : second.metadata ? "the first log"
                                              : "either log";
  return std::string("no LOG_METADATA in ") + which +
         ": whether both are of one robot.yaml, preset and version cannot be told";
}

/// Of the fields that say what ran; not of host and time.
std::vector<std::string> compare_metadata(const LoggedRun& first, const LoggedRun& second) {
  if (!first.metadata || !second.metadata) return {without_metadata(first, second)};
  std::vector<std::string> out;
  const auto text = [&](const char* what, const std::string& a, const std::string& b) {
    if (a != b) out.push_back(std::string(what) + ": " + a + " and " + b);
  };
  text("version", first.metadata->version, second.metadata->version);
  text("git hash", first.metadata->git_hash, second.metadata->git_hash);
  text("robot", first.metadata->robot, second.metadata->robot);
  text("preset", first.metadata->preset, second.metadata->preset);
  text("clock", first.metadata->clock, second.metadata->clock);
  if (first.metadata->robot_yaml != second.metadata->robot_yaml)
    out.emplace_back("robot.yaml is not the same");
  return out;
}

}  // namespace

bool DiffResult::identical() const noexcept {
  bool any = false;
  for (const auto& [channel, counts] : channels) {
    if (counts.differing + counts.only_first + counts.only_second > 0) return false;
    any = any || counts.in_both > 0;
  }
  return any;
}

DiffResult diff_logs(const DiffRequest& request, const ReplayProgress& progress) {
  DiffResult result;
  result.differences = DifferenceTable(request.courses);
  result.metadata = compare_metadata(read_logged_run(request.first), read_logged_run(request.second));
  Side sides[2] = {{request.first, request}, {request.second, request}};
  Matcher matcher(result);
  std::int64_t events = 0;
  for (Candidate candidate; !sides[0].ended() || !sides[1].ended();) {
    // The one that is behind goes on, so that little waits for its like.
    const bool second = sides[0].ended() || (!sides[1].ended() && sides[1].time_s() < sides[0].time_s());
    Side& side = sides[second ? 1 : 0];
    if (side.next(candidate)) matcher.add(candidate, second ? 1 : 0, sides[second ? 0 : 1].ended());
    if (progress && ++events % kDiffProgressEvents == 0)
      progress(sides[0].position() + sides[1].position(), sides[0].file_bytes() + sides[1].file_bytes());
  }
  matcher.finish();
  return result;
}

}  // namespace sprung
