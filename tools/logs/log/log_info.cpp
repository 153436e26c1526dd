#include "tools/logs/log/log_info.h"

#include <algorithm>
#include <limits>

#include "lcmtypes/channels.h"
#include "runtime/message_layout.h"
#include "tools/logs/log/time_span.h"
#include "tools/logs/log/timeline.h"
#include "tools/logs/log/writer.h"

namespace sprung::log {

namespace {

constexpr std::size_t kFingerprint = 8;

class ChannelCounter {
 public:
  ChannelCounter(std::string_view channel, const fields::TypeTable& types);
  void add(const Event& event, const Timeline::Moment& moment);
  ChannelReport report() const;

 private:
  void note_type(const Event& event);

  const fields::TypeTable& types_;
  ChannelReport report_;
  std::int64_t hash_ = 0;
  SessionGapTracker cycles_;
};

ChannelCounter::ChannelCounter(std::string_view channel, const fields::TypeTable& types) : types_(types) {
  report_.cyclic = has_every_cycle(channel);
}

void ChannelCounter::note_type(const Event& event) {
  const std::int64_t hash = event.size < kFingerprint ? 0 : read_int64(event.data, 0);
  if (report_.messages > 0 && hash == hash_) return;
  const fields::StructType* const type = types_.by_hash(hash);
  const std::string name = type == nullptr ? "" : type->name;
  report_.type = report_.messages == 0 || name == report_.type ? name : "several types";
  hash_ = hash;
}

void ChannelCounter::add(const Event& event, const Timeline::Moment& moment) {
  note_type(event);
  if (report_.messages == 0) report_.first_s = report_.last_s = moment.time_s;
  if (moment.time_s - report_.last_s > report_.longest_pause_s) {
    report_.longest_pause_s = moment.time_s - report_.last_s;
    report_.longest_pause_at_s = report_.last_s;
  }
  report_.last_s = std::max(report_.last_s, moment.time_s);
  ++report_.messages;
  report_.bytes += event.size;
  if (report_.cyclic && moment.stamp) cycles_.add(moment.stamp->session, moment.stamp->seq);
}

ChannelReport ChannelCounter::report() const {
  ChannelReport report = report_;
  report.cycles = cycles_.counts();
  return report;
}

/// Counts that need the event before.
class Clockwork {
 public:
  void add(const Event& event, const Timeline::Moment& moment, LogInfo& info) {
    ++info.events;
    if (moment.stamp && sessions_.insert(moment.stamp->session).second) ++info.sessions;
    info.duration_s = std::max(info.duration_s, moment.time_s);
    if (event.channel == channels::kLogMetadata) return;  // see timeline.cpp
    if (!begun_) newest_us_ = earliest_us_ = before_us_ = event.time_us;
    begun_ = true;
    info.went_back += event.time_us < before_us_ ? 1 : 0;
    before_us_ = event.time_us;
    newest_us_ = std::max(newest_us_, event.time_us);
    earliest_us_ = std::min(earliest_us_, event.time_us);
    info.received_s = 1e-6 * (static_cast<double>(newest_us_) - static_cast<double>(earliest_us_));
  }

 private:
  bool begun_ = false;
  std::int64_t before_us_ = 0;
  std::int64_t newest_us_ = 0;
  std::int64_t earliest_us_ = 0;
  std::set<std::int64_t> sessions_;
};

void note_frame(const Event& event, LogInfo& info) {
  if (event.channel == channels::kLogMetadata && !info.metadata)
    info.metadata = read_log_metadata(event.data, event.size);
  if (event.channel == channels::kLogEnd) {
    if (const auto end = read_log_end(event.data, event.size)) info.end = end;
  }
}

void note_damages(const Reader& reader, LogInfo& info) {
  info.damages = reader.damage_count();
  info.skipped_bytes = reader.skipped_bytes();
  if (!info.being_written || !ends_inside_an_event(reader)) return;
  --info.damages;
  info.skipped_bytes -= reader.damages().back().bytes;
}

}  // namespace

double ChannelReport::rate_Hz() const noexcept {
  const std::int64_t counted = messages - cycles.repeats;
  if (counted < 2 || !(last_s > first_s)) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<double>(counted - 1) / (last_s - first_s);
}

bool ends_inside_an_event(const Reader& reader) noexcept {
  return !reader.damages().empty() && reader.damages().back().kind == DamageKind::kCutOff;
}

std::int64_t LogInfo::missing() const noexcept {
  std::int64_t sum = 0;
  for (const auto& [name, channel] : channels) sum += channel.cycles.missing;
  return sum;
}

LogInfo collect_info(Reader& reader, const std::vector<std::string>& leg_names, const Progress& progress) {
  LogInfo info;
  info.path = reader.path();
  info.bytes = reader.file_bytes();
  info.being_written = is_being_written(reader.path());
  Timeline timeline;
  Clockwork clockwork;
  IncidentFinder incidents(leg_names);
  std::map<std::string, ChannelCounter, std::less<>> counters;
  for (Event event; reader.next(event);) {
    const Timeline::Moment moment = timeline.next(event);
    clockwork.add(event, moment, info);
    auto counter = counters.find(event.channel);
    if (counter == counters.end())
      counter = counters.try_emplace(std::string(event.channel), event.channel, fields::TypeTable::sprung())
                    .first;
    counter->second.add(event, moment);
    incidents.add(event, moment);
    note_frame(event, info);
    if (progress && info.events % kEventsBetween == 0) progress(reader.position(), info.bytes);
  }
  for (const auto& [name, counter] : counters) info.channels.emplace(name, counter.report());
  info.begin_us = timeline.begin_us();
  info.incidents = incidents.incidents();
  info.incidents_left_out = incidents.left_out();
  info.not_deterministic = incidents.not_deterministic();
  info.without_answer = incidents.without_answer();
  info.said = incidents.said();
  info.leg_counts = incidents.leg_counts();
  note_damages(reader, info);
  return info;
}

LogExtent extent_of(Reader& reader) {
  Timeline timeline;
  LogExtent extent;
  for (Event event; reader.next(event);) extent.end_s = std::max(extent.end_s, timeline.next(event).time_s);
  extent.begin_us = timeline.begin_us();
  reader.rewind();
  return extent;
}

std::optional<sprung_msgs::log_metadata_t> find_metadata(Reader& reader) {
  std::optional<sprung_msgs::log_metadata_t> found;
  Event event;
  for (int i = 0; i < kEventsToLookAt && !found && reader.next(event); ++i) {
    if (event.channel == channels::kLogMetadata) found = read_log_metadata(event.data, event.size);
  }
  reader.rewind();
  return found;
}

std::string made_by(const std::optional<sprung_msgs::log_metadata_t>& metadata) {
  if (!metadata || metadata->version.empty()) return "";
  return metadata->version + (metadata->git_hash.empty() ? "" : " (" + metadata->git_hash + ")");
}

}  // namespace sprung::log
