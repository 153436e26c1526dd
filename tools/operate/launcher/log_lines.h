#pragma once
/// Lines that processes write, told apart and dated: pure.
#include <cstddef>
#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace sprung {

struct LogLine {
  std::int64_t utc_us = 0;  ///< when the launcher read it
  std::string program;
  std::string text;
};

/// Bytes in, whole lines out. A line that never ends comes in pieces of kLongest.
class LineSplitter {
 public:
  static constexpr std::size_t kLongest = 4096;
  std::vector<std::string> add(const std::string& bytes);
  /// What waits for its end, once no more can come; empty = nothing.
  std::string rest();

 private:
  std::string waiting_;
};

/// As it is shown: a line of runtime/log.h already says when and who; any other gets both in front, UTC.
std::string dated(const LogLine& line);

/// The newest lines.
class LogLines {
 public:
  explicit LogLines(std::size_t capacity) : capacity_(capacity) {}
  void add(LogLine line);
  const std::deque<LogLine>& lines() const noexcept { return lines_; }  ///< oldest first

 private:
  std::size_t capacity_;
  std::deque<LogLine> lines_;
};

}  // namespace sprung
