#include "tools/can/decode/candump_text.h"

#include <charconv>
#include <cinttypes>
#include <cstdio>
#include <sstream>
#include <vector>

namespace sprung::cantools {
namespace {

constexpr std::uint32_t kErrorFlag = 0x20000000;
constexpr std::size_t kStandardDigits = 3;

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

bool parse_hex(const std::string& text, std::uint32_t& value) {
  const auto [last, error] = std::from_chars(text.data(), text.data() + text.size(), value, 16);
  return error == std::errc() && last == text.data() + text.size() && !text.empty();
}

/// Beyond them microseconds do not fit.
constexpr std::int64_t kMostSeconds = 9'000'000'000'000;

/// "(1436509052.249713)"; six digits behind the point.
bool parse_time(const std::string& word, std::int64_t& time_us) {
  std::int64_t seconds = 0, micros = 0;
  int end = 0;
  const int found = std::sscanf(word.c_str(), "(%" SCNd64 ".%6" SCNd64 ")%n", &seconds, &micros, &end);
  if (found != 2 || end != static_cast<int>(word.size())) return false;
  if (seconds < 0 || seconds > kMostSeconds || micros < 0) return false;
  time_us = seconds * 1'000'000 + micros;
  return true;
}

/// Digits decide between 11 and 29 bit, as in candump.
CandumpLine parse_id(const std::string& digits, CanFrame& frame) {
  std::uint32_t id = 0;
  if (!parse_hex(digits, id)) return CandumpLine::kBroken;
  frame.error = digits.size() > kStandardDigits && (id & kErrorFlag) != 0;
  if (frame.error) id &= ~kErrorFlag;
  frame.id = id;
  return digits.size() > kStandardDigits && !frame.error ? CandumpLine::kForeign : CandumpLine::kFrame;
}

/// "2A366C2B", "R", "R1", "" ; "#..." is CAN FD.
CandumpLine parse_data(const std::string& data, CanFrame& frame) {
  if (!data.empty() && data[0] == '#') return CandumpLine::kForeign;
  if (!data.empty() && data[0] == 'R') {
    frame.remote = true;
    frame.length = data.size() > 1 ? static_cast<std::uint8_t>(data[1] - '0') : 0;
    return data.size() <= 2 && frame.length <= 8 ? CandumpLine::kFrame : CandumpLine::kBroken;
  }
  if (data.size() % 2 != 0) return CandumpLine::kBroken;
  if (data.size() > 16) return CandumpLine::kForeign;
  for (std::size_t at = 0; at < data.size(); at += 2) {
    std::uint32_t byte = 0;
    if (!parse_hex(data.substr(at, 2), byte)) return CandumpLine::kBroken;
    frame.data[frame.length++] = static_cast<std::uint8_t>(byte);
  }
  return CandumpLine::kFrame;
}

/// candump's own end of a line; anything else there is no line of candump.
bool parse_direction(const std::vector<std::string>& words, std::size_t at, Direction& direction) {
  if (words.size() <= at) return true;
  if (words.size() > at + 1 || (words[at] != "T" && words[at] != "R")) return false;
  direction = words[at] == "T" ? Direction::kSent : Direction::kReceived;
  return true;
}

/// Words from the interface on: "can0 044#2A36 [T]".
CandumpLine parse_log(const std::vector<std::string>& words, std::size_t at, ObservedFrame& frame) {
  const std::string& word = words[at + 1];
  const std::size_t hash = word.find('#');
  const CandumpLine id = parse_id(word.substr(0, hash), frame.frame);
  if (id == CandumpLine::kBroken) return id;
  const CandumpLine data = parse_data(word.substr(hash + 1), frame.frame);
  if (data == CandumpLine::kBroken || !parse_direction(words, at + 2, frame.direction))
    return CandumpLine::kBroken;
  return data == CandumpLine::kForeign ? data : id;
}

/// Words from the interface on: "can0 044 [4] 2A 36 6C 2B" with "can0 TX - - 044 ..." under -x; error frames'
/// explanations follow on lines of their own and are broken lines to us.
CandumpLine parse_plain(const std::vector<std::string>& words, std::size_t at, ObservedFrame& frame) {
  std::size_t next = at + 1;
  if (words[next] == "TX" || words[next] == "RX") {
    frame.direction = words[next] == "TX" ? Direction::kSent : Direction::kReceived;
    next += 3;
  }
  if (words.size() < next + 2) return CandumpLine::kBroken;
  const CandumpLine id = parse_id(words[next], frame.frame);
  if (id == CandumpLine::kBroken) return id;
  int length = 0, end = 0;
  const std::string& bracket = words[next + 1];
  if (std::sscanf(bracket.c_str(), "[%d]%n", &length, &end) != 1 || end != static_cast<int>(bracket.size()))
    return CandumpLine::kBroken;
  if (length > 8) return CandumpLine::kForeign;
  std::string data;
  for (std::size_t i = next + 2; i < words.size() && i < next + 2 + static_cast<std::size_t>(length); ++i)
    data += words[i];
  if (data.rfind("remote", 0) == 0) data = "R" + std::to_string(length);
  const CandumpLine bytes = parse_data(data, frame.frame);
  if (bytes != CandumpLine::kFrame || frame.frame.length != length) return CandumpLine::kBroken;
  return id;
}

}  // namespace

CandumpLine parse_candump(const std::string& line, std::string& interface, ObservedFrame& frame) {
  const std::vector<std::string> words = words_of(line);
  if (words.empty()) return CandumpLine::kNothing;
  frame.time_us = 0;
  frame.direction = Direction::kUnknown;
  frame.frame = {};
  const bool timed = words[0][0] == '(';
  if (timed && !parse_time(words[0], frame.time_us)) return CandumpLine::kBroken;
  const std::size_t at = timed ? 1 : 0;
  if (words.size() < at + 2) return CandumpLine::kBroken;
  interface = words[at];
  const bool log_format = words[at + 1].find('#') != std::string::npos;
  return log_format ? parse_log(words, at, frame) : parse_plain(words, at, frame);
}

std::string candump_line(const ObservedFrame& observed, const std::string& interface, std::int64_t utc_us) {
  const CanFrame& frame = observed.frame;
  char text[96];
  std::snprintf(text, sizeof text, "(%010" PRId64 ".%06" PRId64 ") ", utc_us / 1'000'000, utc_us % 1'000'000);
  std::string line = text + interface;
  std::snprintf(text, sizeof text, frame.error ? " %08X#" : " %03X#",
                static_cast<unsigned>(frame.id | (frame.error ? kErrorFlag : 0)));
  line += text;
  if (frame.remote) {
    line += frame.length == 0 ? "R" : "R" + std::to_string(frame.length);
  } else {
    for (int i = 0; i < frame.length; ++i) {
      std::snprintf(text, sizeof text, "%02X", frame.data[i]);
      line += text;
    }
  }
  if (observed.direction == Direction::kSent) line += " T";
  if (observed.direction == Direction::kReceived) line += " R";
  return line;
}

std::string candump_fd_line(const ObservedFdFrame& observed, const std::string& interface,
                            std::int64_t time_us) {
  const CanFdFrame& frame = observed.frame;
  char text[96];
  std::snprintf(text, sizeof text, "(%010" PRId64 ".%06" PRId64 ") ", time_us / 1'000'000,
                time_us % 1'000'000);
  std::string line = text + interface;
  const int flags = (frame.fast ? 1 : 0) | (frame.passive ? 2 : 0);
  std::snprintf(text, sizeof text, frame.extended ? " %08X##%X" : " %03X##%X",
                static_cast<unsigned>(frame.id), static_cast<unsigned>(flags));
  line += text;
  for (int i = 0; i < frame.length; ++i) {
    std::snprintf(text, sizeof text, "%02X", frame.data[static_cast<std::size_t>(i)]);
    line += text;
  }
  return line;
}

}  // namespace sprung::cantools
