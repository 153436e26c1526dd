#pragma once
/// What a recorder loses: `sprung bench recorder`. Starts programs, makes files.
#include <functional>
#include <string>
#include <vector>

#include "tools/lab/run/experiment_report.h"

namespace sprung {

struct RecorderBench {
  int runs = 10;
  int messages = 25'000;  ///< in each run, on five channels
  double rate_Hz = 5000.0;
  int hogs = 4;        ///< processes that do nothing but take the processor
  std::string folder;  ///< for the logs
  std::function<void(int run)> on_run;
};

/// sprung-recorder and lcm-logger record the same network in the same runs. @throws std::runtime_error where
/// a program is missing or does not begin.
std::vector<ReportRow> bench_recorder(const RecorderBench& bench);

}  // namespace sprung
