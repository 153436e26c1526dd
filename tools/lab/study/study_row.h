#pragma once
/// What a run became: one line that is the same bytes wherever and whenever it was made by one build.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "tools/lab/run/experiment_report.h"
#include "tools/lab/study/study.h"

namespace sprung {

/// What, besides its run, decides every bit of a row.
struct StudyOrigin {
  std::string version;  ///< of the programs
  std::string files;    ///< hash of the robot's files
};

/// This build, and that robot's folder as it is. @throws ConfigError where there is none.
StudyOrigin origin_of(const std::string& robot);

/// A robot that was read, for the next run of the same one: runs of a set of numbers stand together.
struct LoadedRobot {
  std::string what;  ///< robot, numbers and hash of its files
  RobotConfig robot;
};

/// @param loaded what the last run has left, and the next may find.
/// @throws std::bad_alloc where the machine and not the run is at fault; whatever else goes wrong is the
/// row's `failure`.
std::string study_row(const StudyRun& run, LoadedRobot& loaded);

/// A row read again.
struct StudyResult {
  std::int64_t number = 0;
  std::string study;
  StudyOrigin origin;
  StudyRun run;
  std::string command;  ///< that repeats it
  std::string failure;  ///< why there are no rows; empty: it ran
  std::vector<ReportRow> rows;
};

/// @throws std::invalid_argument where the text is no row.
StudyResult result_of(const std::string& row);

}  // namespace sprung
