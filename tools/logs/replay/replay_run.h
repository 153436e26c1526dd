#pragma once
/// `sprung replay LOG --into CORES`: a log through the cores as fast as it goes. Reads files, and writes one
/// where asked.
#include <functional>
#include <limits>
#include <string>

#include "tools/logs/replay/core_replay.h"
#include "tools/logs/replay/difference_table.h"
#include "tools/logs/replay/logged_run.h"

namespace sprung {

struct ReplayRequest {
  std::string log;
  std::string robot;   ///< folder, name or robot.yaml instead of the log's own; empty = the log's own
  std::string preset;  ///< instead of the log's own; empty = the log's own
  CoreChoice cores;
  /// Robot's time since the begin of the log: what is earlier runs, but is not compared.
  double from_s = 0.0;
  double to_s = std::numeric_limits<double>::infinity();  ///< the replay ends there
  std::string out;                                        ///< LCM log of what the cores say now; empty = none
  bool courses = false;  ///< keep the course of each field's difference, for plots
};

struct ReplayResult {
  ReplayCounts counts;
  LogFlaws flaws;
  DifferenceTable differences;
  std::string source;                 ///< of robot and preset
  std::string robot;                  ///< name
  std::string clock;                  ///< of the log; may be empty
  std::string version;                ///< and git hash of what made it; empty where the log does not say
  std::int64_t last_logged_seq = -1;  ///< cycle with which the log ends
  double replayed_s = 0.0;            ///< robot's time
  double wall_s = 0.0;
  double processor_s = 0.0;   ///< of this process meanwhile: on a busy machine less than the wall time
  std::uint64_t damages = 0;  ///< of the file

  bool identical() const noexcept;  ///< all was compared, all of it is the same, and no input was missing
  double times_real_time() const noexcept { return wall_s > 0.0 ? replayed_s / wall_s : 0.0; }
};

/// Told now and then how many bytes of how many are done.
using ReplayProgress = std::function<void(std::uint64_t done, std::uint64_t all)>;

/// @throws std::runtime_error where the log, or the robot, does not fit; std::invalid_argument where `out` is
/// the log itself.
ReplayResult run_replay(const ReplayRequest& request, const ReplayProgress& progress = {});

}  // namespace sprung
