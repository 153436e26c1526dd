#pragma once
/// `sprung experiment drop`: landings from 0.1 to 0.5 m in each mode, and adaptive landing against the
/// papers' hybrid law (preset `paper`) on the same plant, with a floor that is not where it is expected: 50
/// times from 0.3 m, five times from each other height.
#include <functional>
#include <vector>

#include "tools/common/report/report.h"
#include "tools/lab/landing/drop.h"
#include "tools/lab/run/experiment.h"

namespace sprung {

inline constexpr const char* kPaperPreset = "paper";

struct DropRow {
  JumpMode mode = JumpMode::kHybrid;
  double height_m = 0.0;
  DropResult result;
};

/// One seed: both laws, the same surprise.
struct DropPair {
  double height_m = 0.0;
  std::uint64_t seed = 0;
  double surprise_s = 0.0;
  DropResult adaptive;
  DropResult paper;
};

struct DropExperiment {
  std::vector<DropRow> landings;
  std::vector<DropPair> pairs;  ///< those from 0.3 m first
  std::vector<ReportRow> rows;
  double simulated_s = 0.0;
};

struct DropRequest {
  std::string preset;  ///< empty = the robot's usual one
  SimOptions sim;      ///< its seed is the noise's in the comparison's first
  int seeds = 50;
  std::uint64_t floor = 1;  ///< which floors are drawn: that of the comparison's first
  int jobs = 0;             ///< of parallel.h
  std::function<void(std::size_t done, std::size_t count)> on_progress =
      {};  ///< of parallel.h, over all drops
};

/// @throws std::invalid_argument where fewer than one seed is asked for, CaseError where a drop failed (no
/// preset `paper`, refusals).
DropExperiment run_drop_experiment(const RobotConfig& robot, const DropRequest& request,
                                   const ScriptRunner& run);

Experiment drop_experiment();

/// Tables and plots of `sprung experiment drop`. One drop from 0.3 m in each mode is run again for the plots.
std::vector<report::Section> drop_sections(const RobotConfig& robot, const DropRequest& request,
                                           const DropExperiment& experiment, const ScriptRunner& run);

}  // namespace sprung
