#pragma once
/// When each event of a log is due on a network, at what speed, in which part of the log. Pure.
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace sprung {

/// Wall times at which events are sent.
class ReplayPace {
 public:
  /// @param speed times real time; 0 = as fast as it goes.
  explicit ReplayPace(double speed) noexcept : speed_(speed) {}

  /// @param time_s of the event in the log. @param now_us wall time. @return wall time at which it is due.
  /// The first event is due now, and so is one that comes after begin_again().
  std::int64_t due_us(double time_s, std::int64_t now_us) noexcept;
  void begin_again() noexcept { begun_ = false; }

 private:
  double speed_;
  bool begun_ = false;
  double first_s_ = 0.0;
  std::int64_t first_us_ = 0;
};

/// Names under which channels are sent: "OLD=NEW".
class ChannelNames {
 public:
  /// @throws std::invalid_argument on a text that is not OLD=NEW, or two of one OLD.
  explicit ChannelNames(const std::vector<std::string>& remaps);
  /// The name itself where nothing was said of it. Valid as long as this and `channel` are.
  const char* of(const std::string& channel) noexcept;
  /// Old names that were never asked for.
  std::vector<std::string> unused() const;

 private:
  struct Name {
    std::string old_name;
    std::string new_name;
    bool used = false;
  };
  std::vector<Name> names_;
};

}  // namespace sprung
