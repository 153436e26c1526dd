#pragma once
/// `sprung experiment terrain`: the hardest level of each task that a robot passes in each gait.
#include <functional>
#include <string>
#include <vector>

#include "tools/lab/run/experiment.h"
#include "tools/lab/terrain/terrain_task.h"

namespace sprung {

/// Of one task in one gait.
struct TerrainOutcome {
  const TerrainTask* task = nullptr;
  std::string gait;
  int level = -1;  ///< index of the hardest that was passed; -1: none
  struct Tried {
    int level = 0;
    std::vector<TerrainRun> runs;

    int passed() const;
  };
  std::vector<Tried> tried;  ///< in the order of the search
};

/// terrain.TASK.GAIT.level: pure. NaN where not even the easiest was passed.
ReportRow terrain_row(const TerrainOutcome& outcome);
/// terrain.payload.GAIT.*: how far what the robot says of its payload is off, worst of those who passed the
/// hardest level, after they stood up and when they had walked. Pure; none where nobody passed.
std::vector<ReportRow> payload_rows(const TerrainOutcome& outcome);
/// Of the page that plays one run, without ".html". Pure. @param level index.
std::string terrain_page_name(const TerrainOutcome& outcome, int level, double draw);
/// The command that repeats one run with a log, and plays it. Pure.
/// @param common_words as ExperimentInput's: a later `--plant draw=` counts.
std::string terrain_repeat(const std::string& common_words, const TerrainOutcome& outcome, double level,
                           double draw, double distance_m);
using HowToSee = std::function<std::string(double level, double draw)>;
/// Levels tried, and of each run that did not pass its draw, what became of it and when. Pure.
report::Section terrain_section(const TerrainOutcome& outcome, const HowToSee& how_to_see);

Experiment terrain_experiment();

}  // namespace sprung
