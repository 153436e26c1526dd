#include "tools/logs/log/info_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "runtime/utc_text.h"

namespace sprung::log {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kIncidentsShown = 40;
constexpr std::size_t kNameWidth = 18;
constexpr double kMega = 1e6;

template <class... Values>
std::string format(const char* pattern, Values... values) {
  char line[400];
  std::snprintf(line, sizeof line, pattern, values...);
  return line;
}

std::string size_text(std::uint64_t bytes) {
  const auto value = static_cast<double>(bytes);
  if (bytes < 1000) return format("%llu B", static_cast<unsigned long long>(bytes));
  return value < kMega ? format("%.1f kB", value / 1e3) : format("%.1f MB", value / kMega);
}

/// "ab1-command.lcm (3 events), ..." joined by ", ".
std::string joined(const std::vector<std::string>& parts) {
  std::string out;
  for (const std::string& part : parts) out += (out.empty() ? "" : ", ") + part;
  return out;
}

std::string head_text(const LogInfo& info) {
  std::string out = info.path + ": " + size_text(info.bytes) + ", " + std::to_string(info.events) +
                    " events, " +
                    format("%.3f s of the robot's time, received in %.3f s\n", info.duration_s,
                           info.received_s);
  if (info.events > 0) out += "begins     " + utc_text(info.begin_us, ' ', 3) + " UTC\n";
  if (info.sessions > 1) out += "sessions   " + std::to_string(info.sessions) + "\n";
  return out;
}

std::string metadata_text(const sprung_msgs::log_metadata_t& metadata) {
  const std::string simulated = metadata.simulation != 0 ? ", simulated" : "";
  std::string out = "robot      " + metadata.robot + ", preset " + metadata.preset + ", " + metadata.clock +
                    simulated + "\n";
  out += "made by    sprung " + metadata.version + " (" + metadata.git_hash + ") on " + metadata.host + ": " +
         metadata.command_line + "\n";
  out += format("part       %d; robot.yaml inside: %zu bytes\n", static_cast<int>(metadata.part),
                metadata.robot_yaml.size());
  return out;
}

std::string end_text(const LogInfo& info) {
  if (info.end) {
    const std::string why = name(static_cast<LogEndReason>(info.end->reason));
    return "ended      " + why + (info.end->detail.empty() ? "" : ": " + info.end->detail) + "\n";
  }
  if (info.being_written) return "ended      not yet: it is still being written\n";
  return info.metadata ? "ended      without LOG_END: cut out of another log, or the recorder was killed\n"
                       : "";
}

std::string damage_text(const LogInfo& info) {
  std::string out;
  if (info.damages > 0) {
    out += "damaged    " + std::to_string(info.damages) + " places, " + std::to_string(info.skipped_bytes) +
           " bytes left out: see sprung log verify\n";
  }
  if (info.missing() > 0)
    out += "missing    " + std::to_string(info.missing()) + " cycles, by channel below\n";
  if (info.not_deterministic > 0)
    out += "lock-step  not deterministic: " + std::to_string(info.not_deterministic) +
           " cycles were made from older messages than their own, listed below\n";
  if (info.without_answer > 0)
    out += "lock-step  not deterministic: the bridge went on without an answer " +
           std::to_string(info.without_answer) + " times, listed below\n";
  for (const std::string& what : info.said) out += "lock-step  not deterministic: " + what + "\n";
  if (info.went_back > 0)
    out += "order      " + std::to_string(info.went_back) +
           " events were received before the one in front of them\n";
  return out;
}

std::string gap_text(const ChannelReport& report) {
  if (!report.cyclic) return "-";
  return std::to_string(report.cycles.missing);
}

std::string rate_text(const ChannelReport& report) {
  return std::isfinite(report.rate_Hz()) ? format("%.2f", report.rate_Hz()) : "-";
}

/// A foreign or damaged name may be any bytes; a terminal shall show them, not obey them.
std::string printable(const std::string& name) {
  std::string out = name;
  for (char& c : out) {
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  }
  return out;
}

std::string channels_text(const LogInfo& info) {
  std::string out = format("\n%-18s %-18s %9s %8s %7s %7s %7s %9s %8s\n", "channel", "type", "messages",
                           "size", "Hz", "missing", "repeats", "pause, ms", "at, s");
  for (const auto& [name, report] : info.channels) {
    const std::string type = report.type.empty() ? "unknown" : report.type;
    out += printable(name) + std::string(name.size() < kNameWidth ? kNameWidth - name.size() : 0, ' ');
    out += format(" %-18s %9lld %8s %7s %7s %7lld %9.1f %8.3f\n", type.c_str(),
                  static_cast<long long>(report.messages), size_text(report.bytes).c_str(),
                  rate_text(report).c_str(), gap_text(report).c_str(),
                  static_cast<long long>(report.cycles.repeats), 1e3 * report.longest_pause_s,
                  report.longest_pause_at_s);
  }
  return out;
}

std::string leg_counts_text(const LogInfo& info) {
  std::vector<std::string> parts;
  for (std::size_t i = 1; i < kLegEventCount; ++i) {
    if (info.leg_counts[i] > 0)
      parts.push_back(std::string(name(static_cast<LegEvent>(i))) + " " + std::to_string(info.leg_counts[i]));
  }
  return parts.empty() ? "" : "legs: " + joined(parts) + "\n";
}

std::string incidents_text(const LogInfo& info, const InfoTextOptions& options) {
  std::string out;
  std::size_t shown = 0, left = 0;
  for (const Incident& incident : info.incidents) {
    if (!options.every_incident && incident.kind == IncidentKind::kLeg) continue;
    if (!options.every_incident && shown == kIncidentsShown) {
      ++left;
      continue;
    }
    ++shown;
    out += format("%12.3f %9lld  ", incident.time_s, static_cast<long long>(incident.seq)) + incident.text +
           "\n";
  }
  if (left > 0) out += "             and " + std::to_string(left) + " more: add --events\n";
  if (info.incidents_left_out > 0)
    out += "             and " + std::to_string(info.incidents_left_out) +
           " that are not listed: sprung log cut makes shorter logs\n";
  if (!out.empty()) out = format("\n%12s %9s  what happened\n", "time, s", "cycle") + out;
  return out + leg_counts_text(info);
}

Json json_of(const ChannelReport& report) {
  Json out;
  out["type"] = report.type;
  out["messages"] = report.messages;
  out["bytes"] = report.bytes;
  out["rate_Hz"] = std::isfinite(report.rate_Hz()) ? Json(report.rate_Hz()) : Json(nullptr);
  out["first_s"] = report.first_s;
  out["last_s"] = report.last_s;
  out["longest_pause_s"] = report.longest_pause_s;
  out["longest_pause_at_s"] = report.longest_pause_at_s;
  out["missing"] = report.cyclic ? Json(report.cycles.missing) : Json(nullptr);
  out["repeats"] = report.cycles.repeats;
  return out;
}

Json json_of(const sprung_msgs::log_metadata_t& metadata) {
  return Json{{"robot", metadata.robot},     {"preset", metadata.preset},
              {"clock", metadata.clock},     {"simulation", metadata.simulation != 0},
              {"version", metadata.version}, {"git_hash", metadata.git_hash},
              {"host", metadata.host},       {"command_line", metadata.command_line},
              {"lcm_url", metadata.lcm_url}, {"session", metadata.session},
              {"part", metadata.part},       {"configuration_hash", metadata.configuration_hash},
              {"utc_us", metadata.utc_us},   {"robot_yaml", metadata.robot_yaml}};
}

}  // namespace

std::string info_text(const LogInfo& info, const InfoTextOptions& options) {
  return head_text(info) + (info.metadata ? metadata_text(*info.metadata) : "") + end_text(info) +
         damage_text(info) + channels_text(info) + incidents_text(info, options);
}

std::string info_json(const LogInfo& info) {
  Json out;
  out["log"] = info.path;
  out["bytes"] = info.bytes;
  out["events"] = info.events;
  out["begin_utc_us"] = info.begin_us;
  out["received_s"] = info.received_s;
  out["duration_s"] = info.duration_s;
  out["sessions"] = info.sessions;
  out["missing"] = info.missing();
  out["went_back"] = info.went_back;
  out["not_deterministic"] = info.not_deterministic;
  out["without_answer"] = info.without_answer;
  out["said_not_deterministic"] = info.said;
  out["damages"] = info.damages;
  out["skipped_bytes"] = info.skipped_bytes;
  out["metadata"] = info.metadata ? json_of(*info.metadata) : Json(nullptr);
  out["end"] = info.end ? Json{{"reason", name(static_cast<LogEndReason>(info.end->reason))},
                               {"detail", info.end->detail}}
                        : Json(nullptr);
  out["being_written"] = info.being_written;
  out["channels"] = Json::object();
  for (const auto& [name, report] : info.channels) out["channels"][name] = json_of(report);
  out["incidents"] = Json::array();
  for (const Incident& incident : info.incidents)
    out["incidents"].push_back(
        {{"time_s", incident.time_s}, {"cycle", incident.seq}, {"text", incident.text}});
  out["incidents_left_out"] = info.incidents_left_out;
  out["leg_events"] = Json::object();
  for (std::size_t i = 1; i < kLegEventCount; ++i)
    out["leg_events"][name(static_cast<LegEvent>(i))] = info.leg_counts[i];
  return out.dump(1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace sprung::log
