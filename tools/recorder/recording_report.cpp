#include "tools/recorder/recording_report.h"

#include <cstdio>

namespace sprung {

namespace {

std::string channel_line(const std::string& name, const Recording::Channel& channel) {
  const GapCounts& counts = channel.cycles.counts();
  char text[160];
  if (!channel.cyclic) {
    std::snprintf(text, sizeof text, "  %-18s %10lld messages\n", name.c_str(),
                  static_cast<long long>(channel.messages));
    return text;
  }
  std::snprintf(text, sizeof text,
                "  %-18s %10lld messages, %lld cycles missing in %lld gaps, %lld came twice", name.c_str(),
                static_cast<long long>(channel.messages), static_cast<long long>(counts.missing),
                static_cast<long long>(counts.gaps), static_cast<long long>(counts.repeats));
  std::string line = text;
  if (counts.gaps > 0) line += ", first gap at cycle " + std::to_string(counts.first_missing);
  return line + "\n";
}

}  // namespace

std::string recording_report(const Recording& recording, std::size_t longest_queue) {
  std::string out;
  for (const std::string& file : recording.files()) out += "recorded " + file + "\n";
  char text[160];
  std::snprintf(text, sizeof text,
                "  %lld messages, %.1f MB, %lld cycles missing, at most %zu messages waited\n",
                static_cast<long long>(recording.events()), static_cast<double>(recording.bytes()) * 1e-6,
                static_cast<long long>(recording.missing()), longest_queue);
  out += text;
  for (const auto& [name, channel] : recording.channels()) out += channel_line(name, channel);
  if (recording.ended() && *recording.ended() != LogEndReason::kAsked)
    out += std::string("  ended because ") + name(*recording.ended()) + ": " + recording.detail() + "\n";
  return out;
}

}  // namespace sprung
