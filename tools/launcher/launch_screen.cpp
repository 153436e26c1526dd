#include "tools/launcher/launch_screen.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace sprung {
namespace {

constexpr const char* kTitles =
    "process                   state         pid  cpu %  mem MB  rate Hz overruns input ms again";

std::string number(double value, int decimals) {
  if (!std::isfinite(value)) return "-";
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::string table_line(const ProcessRow& row, bool with_host) {
  char text[192];
  std::snprintf(text, sizeof text, "%-25s %-10s %6lld %6s %7s %8s %8s %8s %5d", row.program.c_str(),
                row.state.c_str(), static_cast<long long>(row.pid), number(row.cpu_percent, 1).c_str(),
                number(row.memory_MB, 1).c_str(), number(row.rate_Hz, 0).c_str(),
                number(row.overruns, 0).c_str(), number(row.input_age_ms, 2).c_str(), row.restarts);
  std::string line = text;
  if (with_host) line += "  " + row.host;
  if (!row.detail.empty()) line += "  " + row.detail;
  return line;
}

std::string up_time(double up_s) {
  const int seconds = static_cast<int>(up_s);
  char text[32];
  std::snprintf(text, sizeof text, "%d:%02d:%02d", seconds / 3600, seconds / 60 % 60, seconds % 60);
  return text;
}

/// Whether a line of the log asks for attention, by the level that runtime/log.h writes.
bool complains(const std::string& text) {
  return text.find(" error ") != std::string::npos || text.find(" warning ") != std::string::npos ||
         text.find(" critical ") != std::string::npos;
}

/// No control character of a log line may move the cursor.
std::string fitted(std::string text, std::size_t width) {
  for (char& byte : text) {
    if (static_cast<unsigned char>(byte) < 0x20 || byte == 0x7f) byte = ' ';
  }
  if (text.size() > width) text.resize(width);
  return text;
}

std::vector<ScreenLine> heading(const ScreenContent& content) {
  const bool with_host = std::any_of(content.rows.begin(), content.rows.end(), [&](const ProcessRow& row) {
    return !row.host.empty() && row.host != content.rows.front().host;
  });
  std::vector<ScreenLine> lines{
      {content.robot + " is " + content.phase + "  " + up_time(content.up_s), LineStyle::kHeading},
      {content.facts, LineStyle::kDim},
      {"safety  " + content.safety, content.safety_bad ? LineStyle::kBad : LineStyle::kPlain},
      {"", LineStyle::kPlain},
      {with_host ? std::string(kTitles) + "  host" : kTitles, LineStyle::kHeading}};
  for (const ProcessRow& row : content.rows)
    lines.push_back({table_line(row, with_host), row.bad ? LineStyle::kBad : LineStyle::kPlain});
  lines.push_back({"", LineStyle::kPlain});
  return lines;
}

}  // namespace

std::vector<ScreenLine> launch_screen(const ScreenContent& content, const std::deque<LogLine>& log,
                                      std::size_t width, std::size_t height) {
  std::vector<ScreenLine> lines = heading(content);
  const std::size_t used = lines.size() + 1;  // and the hint
  const std::size_t room = height > used ? height - used : 0;
  for (std::size_t i = log.size() - std::min(room, log.size()); i < log.size(); ++i) {
    const std::string text = dated(log[i]);
    lines.push_back({text, complains(text) ? LineStyle::kBad : LineStyle::kPlain});
  }
  while (lines.size() + 1 < height) lines.push_back({"", LineStyle::kPlain});
  if (lines.size() >= height) lines.resize(height > 0 ? height - 1 : 0);
  if (height > 0) lines.push_back({content.hint, LineStyle::kDim});
  for (ScreenLine& line : lines) line.text = fitted(std::move(line.text), width);
  return lines;
}

}  // namespace sprung
