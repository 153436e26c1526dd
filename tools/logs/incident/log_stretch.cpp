#include "tools/logs/incident/log_stretch.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "tools/logs/log/rewrite.h"
#include "tools/logs/log/robot_names.h"

namespace sprung::log {

namespace {

std::string place_text(const Incident& incident, const std::string& log) {
  char place[80];
  std::snprintf(place, sizeof place, ", at %.3f s (cycle %lld) of ", incident.time_s,
                static_cast<long long>(incident.seq));
  return place + log;
}

namespace fs = std::filesystem;

LogInfo info_of(const std::string& log, const Progress& progress) {
  Reader reader(log);
  const std::vector<std::string> legs = names_in_log(reader).legs;
  return collect_info(reader, legs, progress);
}

double length_of(const std::string& log) {
  Reader reader(log);
  return extent_of(reader).end_s;
}

}  // namespace

std::optional<Trip> last_trip(const std::vector<Incident>& incidents) {
  std::optional<Trip> trip;
  bool tripped = false, heard = false;
  for (const Incident& incident : incidents) {
    if (incident.kind == IncidentKind::kSession) tripped = heard = false;
    if (incident.kind != IncidentKind::kSafety) continue;
    if (incident.trip && !tripped) trip = Trip{incident, incident, !heard};
    if (incident.trip) trip->last = incident;
    tripped = incident.trip;
    heard = true;
  }
  return trip;
}

std::string trip_text(const std::optional<Trip>& trip, const std::string& log) {
  if (!trip) return "cause: none found, safety stopped nothing in " + log + "\n";
  const std::string since = trip->from_before ? " (it was there when the log began)" : "";
  std::string out = "cause: " + trip->first.text + place_text(trip->first, log) + since + "\n";
  if (trip->last.text != trip->first.text)
    out += "then:  " + trip->last.text + place_text(trip->last, log) + "\n";
  return out;
}

LogInfo copy_stretch(const Stretch& stretch, const std::string& to, const Progress& progress) {
  TimeSpan span;
  span.from = TimePoint{TimePoint::Kind::kSinceBegin, stretch.from_s, 0};
  if (stretch.to_s) span.to = TimePoint{TimePoint::Kind::kSinceBegin, *stretch.to_s, 0};
  Reader reader(stretch.log);
  Writer writer(to);
  ChannelFilter every_channel({});
  copy_part(reader, span, every_channel, writer, progress);
  LogInfo info = info_of(to, {});
  info.path = fs::path(to).filename().string();
  return info;
}

std::vector<LogInfo> copy_last(const std::vector<std::string>& parts, double last_s,
                               const std::string& folder, const Progress& progress) {
  std::vector<LogInfo> copies;
  double left_s = last_s;
  for (const std::string& part : parts) {
    const double length_s = length_of(part);
    const std::string to = (fs::path(folder) / fs::path(part).filename()).string();
    copies.push_back(copy_stretch({part, std::max(0.0, length_s - left_s), std::nullopt}, to, progress));
    left_s -= length_s;
    if (!(left_s > 0.0)) break;
  }
  return copies;
}

std::optional<FoundTrip> find_trip(const std::vector<std::string>& parts, const Progress& progress) {
  for (const std::string& part : parts) {
    const auto trip = last_trip(info_of(part, progress).incidents);
    if (trip && !trip->from_before) return FoundTrip{part, *trip};
  }
  return std::nullopt;
}

}  // namespace sprung::log
