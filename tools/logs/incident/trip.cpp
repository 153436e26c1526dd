#include "tools/logs/incident/trip.h"

#include <cstdio>

namespace sprung::log {

namespace {

std::string place_text(const Incident& incident, const std::string& log) {
  char place[80];
  std::snprintf(place, sizeof place, ", at %.3f s (cycle %lld) of ", incident.time_s,
                static_cast<long long>(incident.seq));
  return place + log;
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

}  // namespace sprung::log
