#pragma once
/// Two logs beside each other: messages of one cycle on one channel belong together. Reads files, both as
/// streams.
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "tools/logs/replay/difference_table.h"
#include "tools/logs/replay/replay_run.h"

namespace sprung {

struct DiffRequest {
  std::string first;
  std::string second;
  /// As ChannelFilter; empty = those with one message each cycle. Of others the n-th of both belong together.
  std::vector<std::string> channels;
  double from_s = 0.0;  ///< robot's time since the begin of each log
  double to_s = std::numeric_limits<double>::infinity();
  bool courses = false;  ///< keep the course of each field's difference, for plots
};

struct ChannelDiff {
  std::int64_t in_both = 0;
  std::int64_t differing = 0;
  std::int64_t only_first = 0;
  std::int64_t only_second = 0;
};

struct DiffResult {
  std::map<std::string, ChannelDiff> channels;
  DifferenceTable differences;
  std::size_t most_waiting = 0;       ///< messages of a channel that were held at once until their like came
  std::vector<std::string> metadata;  ///< what LOG_METADATA of both says differently, a line each

  bool identical() const noexcept;  ///< something was compared, and nothing differs or is in one log alone
};

/// Session and times (utime) are left out: they differ between any two runs in real time.
/// @throws std::runtime_error where a log cannot be read.
DiffResult diff_logs(const DiffRequest& request, const ReplayProgress& progress = {});

}  // namespace sprung
