#pragma once
/// What receiving costs a message that passes four programs: `sprung bench hops`.
#include <vector>

#include "tools/lab/run/experiment_report.h"

namespace sprung {

struct HopsBench {
  int runs = 5;         ///< of each receiver, in turn
  int messages = 1000;  ///< in a run
  double rate_Hz = 500.0;
};

/// A message of 300 bytes goes from thread to thread over LCM's network, four hops, received by ours in one
/// run and by LCM's own in the next. Rows: p50 and p99 of all four, each the median of the runs, and ratios.
/// @throws std::runtime_error where LCM cannot start.
std::vector<ReportRow> bench_hops(const HopsBench& bench);

}  // namespace sprung
