#include "tools/operate/launcher/log_lines.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "runtime/utc_text.h"

namespace sprung {
namespace {

/// Whether a text begins with a date and time.
bool says_when(const std::string& text) {
  constexpr const char* kShape = "0000-00-00T00:00:00.";
  for (std::size_t i = 0; kShape[i] != '\0'; ++i) {
    if (i >= text.size()) return false;
    const bool digit = std::isdigit(static_cast<unsigned char>(text[i])) != 0;
    if (kShape[i] == '0' ? !digit : text[i] != kShape[i]) return false;
  }
  return true;
}

}  // namespace

std::vector<std::string> LineSplitter::add(const std::string& bytes) {
  std::vector<std::string> lines;
  for (const char byte : bytes) {
    if (byte != '\n') waiting_.push_back(byte);
    if (byte == '\n' || waiting_.size() == kLongest) lines.push_back(std::exchange(waiting_, {}));
  }
  return lines;
}

std::string LineSplitter::rest() { return std::exchange(waiting_, {}); }

std::string dated(const LogLine& line) {
  if (says_when(line.text)) return line.text;
  // As runtime/log.h writes it, but UTC: no time zone is asked for.
  return utc_text(line.utc_us, 'T', 6) + " " + line.program + ": " + line.text;
}

void LogLines::add(LogLine line) {
  if (lines_.size() == capacity_) lines_.pop_front();
  if (capacity_ > 0) lines_.push_back(std::move(line));
}

}  // namespace sprung
