#pragma once
/// `sprung replay LOG`: a log's messages onto an LCM network again. Shell: reads a file, sends, sleeps.
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace sprung {

/// Wall times at which a log's events are due on a network.
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

struct LcmReplayRequest {
  std::string log;
  std::string lcm_url;
  double start_s = 0.0;  ///< robot's time since the begin of the log
  double duration_s = std::numeric_limits<double>::infinity();
  double speed = 1.0;                 ///< times real time; 0 = as fast as it goes
  bool loop = false;                  ///< from the start again at the end, until a stop is asked for
  std::vector<std::string> channels;  ///< as log::ChannelFilter; empty = all
  std::vector<std::string> drop;
  std::vector<std::string> remaps;  ///< OLD=NEW
};

struct LcmReplayResult {
  std::int64_t messages = 0;
  std::int64_t failed = 0;  ///< of them: LCM did not take them
  int laps = 0;
  /// OLD of remaps that no message had, where the log was sent to its end.
  std::vector<std::string> not_renamed;
};

/// Called before each step: before each DRIVE_STATE, or, where none is sent, before each message of the first
/// channel that has one each cycle, or else of the first channel.
/// @param time_s robot's time. @return false: end.
using StepGate = std::function<bool(double time_s)>;

/// Ends at the end of the log, or with a stop request. @param gate empty: no steps.
/// @throws std::invalid_argument on a wrong pattern, remap or address, std::runtime_error where the log or
/// LCM cannot be opened.
LcmReplayResult replay_to_lcm(const LcmReplayRequest& request, const StepGate& gate = {});

}  // namespace sprung
