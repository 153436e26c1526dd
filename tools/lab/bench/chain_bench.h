#pragma once
/// How long a cycle takes on the bus: from its SYNC to its last set-point, as CAN_TRACE of a log has it
/// (`sprung bench chain`). Two builds are compared by a log of each.
#include <cstddef>
#include <string>
#include <vector>

#include "tools/lab/run/experiment_report.h"

namespace sprung {

struct ChainTimes {
  std::size_t cycles = 0;  ///< with a SYNC and a set-point
  double p50_us = 0.0;
  double p99_us = 0.0;
};

/// Of the cycles of a log in real time; in lock-step message time says nothing.
/// @throws std::runtime_error where the file cannot be read, or has no such cycle.
ChainTimes chain_times(const std::string& log);

/// Rows chain.LOG.{cycles,p50,p99}, and with two logs and more chain.ratio.{p50,p99}: medians of the first
/// half of them over those of the second.
std::vector<ReportRow> bench_chain(const std::vector<std::string>& logs);

/// Rows mac.SIZE.time: making the MAC of a message of so many bytes, us, median of `runs`, beside the
/// reference loop.
std::vector<ReportRow> bench_mac(int runs);

}  // namespace sprung
