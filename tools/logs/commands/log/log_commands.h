#pragma once
/// What the subcommands of `sprung log` share.
#include <stdexcept>
#include <string>
#include <vector>

#include "runtime/command_line.h"
#include "tools/logs/log/rewrite.h"
#include "tools/logs/log/robot_names.h"

namespace sprung::commands {

void add_log_info(CommandLine& log);
void add_log_cut(CommandLine& log);  ///< cut, filter
void add_log_merge(CommandLine& log);
void add_log_verify(CommandLine& log);
void add_log_repair(CommandLine& log);
void add_log_csv(CommandLine& log);
void add_log_mcap(CommandLine& log);
void add_log_plot(CommandLine& log);
void add_log_diff(CommandLine& log);

/// "walk-cut.lcm" of "logs/walk.lcm" and "-cut.lcm": in the folder where one stands.
std::string beside(const std::string& log, const std::string& ending);

/// The result of `work`; what is wrong in the user's texts ends with status 2.
template <class Work>
auto or_wrong_use(Work&& work) {
  try {
    return work();
  } catch (const std::invalid_argument& error) {
    throw WrongUse(error.what());
  }
}

/// Shows how far a log is, on a terminal. Hand it over as a temporary: with its end the line is wiped, and
/// results can be printed.
log::Progress progress_line(const std::string& label);

/// Names of the log's joints, legs and actuators. Where there are none, says so on standard error, and what
/// follows from that.
log::RobotNames names_or_told(log::Reader& reader);

/// Names fields that were asked for and are not in the log, on standard error.
void tell_unmatched(const std::string& log, const std::vector<std::string>& fields);

/// One line on what was written, one on what was left out, and one where there was nothing to write. @return
/// exit status.
int tell_rewrite(const std::string& log, const std::string& out, const log::RewriteResult& result);

/// Says so on standard error, and what to look at.
void tell_no_event(const std::string& log);

}  // namespace sprung::commands
