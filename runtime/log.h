#pragma once
/// The one log of a process: lines on standard error, with time, level and process name. Never in a cycle,
/// except through LogLimit. Standard output belongs to the program's results.
#include <cstdint>
#include <string>

namespace sprung {

void start_log(
    const std::string& process);  ///< level from $SPRUNG_LOG: debug, info (default), warn, error, off
void log_debug(const std::string& text);
void log_info(const std::string& text);
void log_warn(const std::string& text);
void log_error(const std::string& text);

/// Lets one line through in each interval and counts the others.
class LogLimit {
 public:
  explicit LogLimit(std::int64_t interval_us) noexcept : interval_us_(interval_us) {}
  bool allow(std::int64_t now_us) noexcept;
  /// Lines kept back before the one that was last allowed.
  std::int64_t kept_back() const noexcept { return kept_back_; }

 private:
  std::int64_t interval_us_;
  std::int64_t next_us_ = 0;
  std::int64_t waiting_ = 0;
  std::int64_t kept_back_ = 0;
  bool any_ = false;
};

}  // namespace sprung
