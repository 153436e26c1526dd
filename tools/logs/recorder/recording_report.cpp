#include "tools/logs/recorder/recording_report.h"

#include <cstdio>

namespace sprung {

namespace {

/// Empty for a channel of which every message came once, or of which nobody can tell.
std::string channel_line(const std::string& name, const GapCounts& counts) {
  if (counts.gaps + counts.repeats == 0) return "";
  char text[160];
  std::snprintf(text, sizeof text, "  %-18s %lld cycles missing in %lld gaps, %lld came twice", name.c_str(),
                static_cast<long long>(counts.missing), static_cast<long long>(counts.gaps),
                static_cast<long long>(counts.repeats));
  std::string line = text;
  if (counts.gaps > 0) line += ", first gap at cycle " + std::to_string(counts.first_missing);
  return line + "\n";
}

}  // namespace

std::string recording_report(const Recording& recording, std::size_t longest_queue) {
  std::string out;
  for (const std::string& file : recording.files()) out += "recorded " + file + "\n";
  char text[160];
  std::snprintf(
      text, sizeof text,
      "  %lld messages on %zu channels, %.1f MB, %lld cycles missing, at most %zu messages waited\n",
      static_cast<long long>(recording.events()), recording.channels().size(),
      static_cast<double>(recording.bytes()) * 1e-6, static_cast<long long>(recording.missing()),
      longest_queue);
  out += text;
  for (const auto& [name, channel] : recording.channels()) out += channel_line(name, channel.cycles.counts());
  if (recording.ended() && *recording.ended() != LogEndReason::kAsked)
    out += std::string("  ended because ") + name(*recording.ended()) + ": " + recording.detail() + "\n";
  return out;
}

}  // namespace sprung
