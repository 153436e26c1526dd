#pragma once
/// Runs of a campaign made by the real processes in lock-step, beside the same runs in this one: where every
/// bit is the same, what the judge said of one holds for the other.
#include <cstdint>
#include <string>
#include <vector>

#include "tools/lab/campaign/draw.h"
#include "tools/lab/run/experiment_report.h"

namespace sprung::campaign {

struct SeparateRun {
  Draw draw;
  std::int64_t cycles = 0;
  std::int64_t first_difference = -1;  ///< cycle; -1: none
  std::string failure;                 ///< it could not be made

  bool same() const noexcept { return failure.empty() && first_difference < 0; }
};

/// The first `most` of these runs that have a script (has_script() of trial.h), one after the other.
/// @throws std::runtime_error where the operator stops it.
std::vector<SeparateRun> run_separately(const RobotConfig& robot, const std::string& preset,
                                        const std::vector<Draw>& draws, int most);

/// Rows campaign.separate.{runs,cycles,different}.
std::vector<ReportRow> separate_rows(const std::vector<SeparateRun>& runs);

}  // namespace sprung::campaign
