#pragma once
/// `sprung campaign`: many robots, each in a drawn state on a drawn plant with one or two drawn things that
/// go wrong, judged by the simulation's truth and the raw frames. In this process.
#include <cstdint>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "tools/common/parallel.h"
#include "tools/common/report/report.h"
#include "tools/lab/campaign/trial.h"
#include "tools/lab/run/experiment_report.h"

namespace sprung::campaign {

struct Request {
  std::string preset;  ///< empty: the robot's usual one
  std::uint64_t seed = 1;
  std::uint64_t first = 0;  ///< number of the first run
  int runs = 1000;
  Class only = Class::kNone;  ///< kNone: every class
  bool twins = true;          ///< they take half of the time
  ParallelOptions parallel;
};

/// Each run, and for each its twin: the same draw with nothing going wrong, which must not be stopped.
struct Result {
  std::vector<Verdict> runs, twins;
};

/// @throws std::invalid_argument for what cannot be asked.
Result run_campaign(const RobotConfig& robot, const Request& request);

/// Rows campaign.<all|class>.*: pure.
std::vector<ReportRow> campaign_rows(const Result& result);

/// Whether anything about this run is not as it should be.
bool bad(const Verdict& verdict) noexcept;
/// The same of a twin, in which nothing went wrong: it was stopped, a rule was broken, or it could not be
/// made.
bool bad_twin(const Verdict& verdict) noexcept;

/// "sprung campaign --robot ..." with what these runs take. @param robot as it was asked for: name or folder.
std::string campaign_command(const std::string& robot, std::uint64_t seed, std::uint64_t first, int runs,
                             Class only);

/// What went wrong in a run and what is not as it should be, and the command that makes it again; a line
/// each. @param asked_robot as for campaign_command().
std::string failure_text(const Verdict& verdict, const RobotConfig& robot, const std::string& asked_robot);

/// Distributions by class and state, and every bad run. @param asked_robot as for campaign_command().
std::vector<report::Section> campaign_sections(const Result& result, const RobotConfig& robot,
                                               const std::string& asked_robot);

/// Largest probability of what was seen in none of so many runs, at 95 %; 1 at most.
double rule_of_three(std::size_t runs) noexcept;

}  // namespace sprung::campaign
