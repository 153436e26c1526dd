#pragma once
/// Planner and leg controller on what a log says that they were given, after the estimator
/// (estimator_replay.h), and whether all of them say what the log says that they said. Pure: cycles in,
/// differences out. The same binary gives the same bits.
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "tools/logs/replay/estimator_replay.h"
#include "tools/logs/replay/log_cycles.h"

namespace sprung {

/// Which cores run. A core that runs gives its output to the next; what the others said is taken from the
/// log.
struct CoreChoice {
  std::array<bool, kCores> runs{true, true, true};
  bool operator[](Core core) const noexcept { return runs[static_cast<std::size_t>(core)]; }
};
/// @param words of "estimator,planner,controller", in any order. @throws std::invalid_argument on another
/// word, or none.
CoreChoice core_choice(const std::string& words);

/// One message, as it is in the log and as the cores make it now; both with the log's session.
struct MessagePair {
  const char* channel = nullptr;
  std::int64_t seq = -1;
  std::int64_t time_us = 0;  ///< UTC, as LoggedCycle
  double time_s = 0.0;       ///< as LoggedCycle
  const Bytes& recorded;     ///< empty: the log has none
  const Bytes& replayed;     ///< empty: no core makes it
};

struct ReplayCounts {
  std::int64_t cycles = 0;      ///< in which a core ran
  std::int64_t compared = 0;    ///< messages, of the cycles that are compared
  std::int64_t differing = 0;   ///< of them
  std::int64_t incomplete = 0;  ///< cycles whose inputs the log does not have; first_incomplete says which
  std::int64_t first_seq = -1;  ///< cycle with which the replay began; cores began fresh there
  std::int64_t last_seq = -1;
  std::string first_incomplete;
  std::int64_t other_version = 0;   ///< messages that were not compared: the log's type is another version's
  std::string first_other_version;  ///< channel of the first of them
};

class CoreReplay {
 public:
  using Use = std::function<void(const MessagePair&)>;

  /// @param preset of `robot`. @param watchdogs that the processes had. @throws std::invalid_argument as the
  /// cores do.
  CoreReplay(const RobotConfig& robot, const std::string& preset, const WatchdogConfig& watchdogs,
             const CoreChoice& choice);
  ~CoreReplay();
  CoreReplay(const CoreReplay&) = delete;
  CoreReplay& operator=(const CoreReplay&) = delete;

  void on_difference(Use use);       ///< gets every message that is not the log's
  void on_output(Use use);           ///< gets every message that a core made
  void compare_from(double time_s);  ///< earlier cycles run, but are not compared; at first: all are

  /// Cycles in ascending order. @param estimated of this cycle; its joint state is taken, and another one of
  /// that size left.
  /// @throws std::runtime_error on messages of another robot, or of another version of their type.
  void step(const LoggedCycle& cycle, EstimatedCycle& estimated);
  const ReplayCounts& counts() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sprung
