#pragma once
/// `sprung study run`: so many workers as processes, each given a run when it has answered the last.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tools/lab/study/study.h"
#include "tools/lab/study/study_folder_shell.h"

namespace sprung {

struct PoolOptions {
  int workers = 1;
  double timeout_s = 600.0;         ///< of a run; then its worker is killed
  std::vector<std::string> worker;  ///< the command of one
  std::function<bool()> stops = [] { return false; };
  /// How many are done, of those that were missing.
  std::function<void(std::size_t done, std::size_t count)> on_progress = {};
};

struct PoolResult {
  std::int64_t kept = 0;
  std::int64_t failed = 0;  ///< runs without a row, noted in the folder
  bool stopped = false;     ///< before all were tried
  int workers_lost = 0;     ///< that ended in the middle of a run, and were replaced
};

/// A run whose worker ends is given to another, ten times in all; one that takes too long once.
/// @throws std::runtime_error where no worker starts, or the folder cannot be written; what is kept is kept.
PoolResult run_pool(const std::vector<StudyRun>& missing, const StudyFolder& folder,
                    const PoolOptions& options);

}  // namespace sprung
