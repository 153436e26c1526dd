#pragma once
/// Jumps that were measured while a simulated robot ran: a page with a table of all and the first one drawn,
/// and a short table for the terminal. Pure.
#include <string>
#include <vector>

#include "tools/common/report/report.h"
#include "tools/lab/jump/jump_metrics.h"
#include "tools/lab/jump/jump_rows.h"
#include "tools/lab/jump/jump_trace.h"

namespace sprung {

struct LiveJumps {
  std::string robot;
  std::string preset;
  JumpMode mode = JumpMode::kHybrid;
  std::string command;              ///< that made them
  std::vector<JumpResult> jumps;    ///< all
  std::vector<JumpSample> samples;  ///< of the first
};

/// @throws std::invalid_argument where there is no jump.
report::Report live_jump_report(const LiveJumps& live);

/// What `sprung jump --report` prints of the jumps it commanded: one line a jump, both torque signals beside
/// each other (errata E8).
std::string jump_table(const std::vector<JumpResult>& jumps);

}  // namespace sprung
