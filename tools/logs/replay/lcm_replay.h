#pragma once
/// `sprung replay LOG`: a log's messages onto an LCM network again. Shell: reads a file, sends, sleeps.
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace sprung {

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
