#include "tools/operate/launcher/launch_screen.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace sprung {
namespace {

/// What goes on in another line is indented by this.
constexpr std::size_t kIndent = 2;
constexpr const char*
    kTitles = "process                 state          pid cpu %    MB   Hz overrun age ms again";

std::string number(double value, int decimals) {
  if (!std::isfinite(value)) return "-";
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", decimals, value);
  return text;
}

std::string table_line(const ProcessRow& row, bool with_host) {
  char text[192];
  std::snprintf(text, sizeof text, "%-23s %-10s %7lld %5s %5s %4s %7s %6s %5d", row.program.c_str(),
                row.state.c_str(), static_cast<long long>(row.pid), number(row.cpu_percent, 1).c_str(),
                number(row.memory_MB, 1).c_str(), number(row.rate_Hz, 0).c_str(),
                number(row.overruns, 0).c_str(), number(row.input_age_ms, 2).c_str(), row.restarts);
  std::string line = text;
  if (with_host) line += "  " + row.host;
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

/// The day stands in the file beside the log, and a screen needs no microseconds: "20:01:25.123 info
/// sprung-x: ..."
std::string without_day(const std::string& line) {
  constexpr std::size_t kDay = 11, kWhole = 26,
                        kMicroseconds = 3;  // "2026-11-21T", "2026-11-21T20:01:25.123456"
  if (line.size() < kWhole) return line;
  return line.substr(kDay, kWhole - kDay - kMicroseconds) + line.substr(kWhole);
}

/// No control character may move the cursor.
std::string harmless(std::string text) {
  for (char& byte : text) {
    if (static_cast<unsigned char>(byte) < 0x20 || byte == 0x7f) byte = ' ';
  }
  return text;
}

/// As many lines as it takes, broken at spaces where there are any.
std::vector<ScreenLine> wrapped(const std::string& text, LineStyle style, std::size_t width) {
  std::vector<ScreenLine> lines;
  std::string rest = harmless(text);
  while (rest.size() > width && width > 2 * kIndent) {
    const std::size_t space = rest.rfind(' ', width);
    const bool whole_words = space != std::string::npos && space > width / 2;
    const std::size_t end = whole_words ? space : width;
    lines.push_back({rest.substr(0, end), style});
    rest = std::string(kIndent, ' ') + rest.substr(end + (whole_words ? 1 : 0));
  }
  lines.push_back({rest.substr(0, width), style});
  return lines;
}

void append(std::vector<ScreenLine>& lines, const std::string& text, LineStyle style, std::size_t width) {
  for (ScreenLine& line : wrapped(text, style, width)) lines.push_back(std::move(line));
}

/// A process, and below it what it has to say.
void append_row(std::vector<ScreenLine>& lines, const ProcessRow& row, bool with_host, std::size_t width) {
  const LineStyle style = row.bad ? LineStyle::kBad : LineStyle::kPlain;
  lines.push_back({harmless(table_line(row, with_host)).substr(0, width), style});
  if (!row.detail.empty())
    append(lines, std::string(kIndent, ' ') + row.detail, row.bad ? style : LineStyle::kDim, width);
}

/// The newest lines that fit into `room`, oldest first.
std::vector<ScreenLine> newest(const std::deque<LogLine>& log, std::size_t width, std::size_t room) {
  std::vector<ScreenLine> lines;
  for (auto line = log.rbegin(); line != log.rend() && lines.size() < room; ++line) {
    const std::string text = dated(*line);
    std::vector<ScreenLine> one = wrapped(without_day(text),
                                          complains(text) ? LineStyle::kBad : LineStyle::kPlain, width);
    one.insert(one.end(), lines.begin(), lines.end());
    lines = std::move(one);
  }
  if (lines.size() > room) lines.erase(lines.begin(), lines.end() - static_cast<std::ptrdiff_t>(room));
  return lines;
}

std::vector<ScreenLine> heading(const ScreenContent& content, std::size_t width) {
  const bool with_host = std::any_of(content.rows.begin(), content.rows.end(), [&](const ProcessRow& row) {
    return !row.host.empty() && row.host != content.rows.front().host;
  });
  std::vector<ScreenLine> lines;
  append(lines, content.robot + " is " + content.phase + "  " + up_time(content.up_s), LineStyle::kHeading,
         width);
  append(lines, content.facts, LineStyle::kDim, width);
  if (!content.log.empty()) append(lines, "log     " + content.log, LineStyle::kDim, width);
  append(lines, "safety  " + content.safety, content.safety_bad ? LineStyle::kBad : LineStyle::kPlain, width);
  lines.push_back({"", LineStyle::kPlain});
  const std::string titles = with_host ? std::string(kTitles) + "  host" : kTitles;
  lines.push_back({titles.substr(0, width), LineStyle::kHeading});
  for (const ProcessRow& row : content.rows) append_row(lines, row, with_host, width);
  lines.push_back({"", LineStyle::kPlain});
  return lines;
}

}  // namespace

std::vector<ScreenLine> launch_screen(const ScreenContent& content, const std::deque<LogLine>& log,
                                      std::size_t width, std::size_t height) {
  std::vector<ScreenLine> hint = wrapped(content.hint, LineStyle::kDim, width);
  if (hint.size() > height) hint.resize(height);
  const std::size_t above = height - hint.size();
  std::vector<ScreenLine> lines = heading(content, width);
  for (ScreenLine& line : newest(log, width, above - std::min(above, lines.size())))
    lines.push_back(std::move(line));
  lines.resize(above, {"", LineStyle::kPlain});
  lines.insert(lines.end(), hint.begin(), hint.end());
  return lines;
}

}  // namespace sprung
