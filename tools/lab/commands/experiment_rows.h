#pragma once
/// Where the rows of an experiment go: a file for scripts, standard output.
#include <string>

#include "tools/lab/run/experiment_report.h"

namespace sprung::commands {

/// FOLDER/<experiment>.json; makes the folder. @throws std::runtime_error naming the file that cannot be
/// written.
void write_rows(const ExperimentReport& rows, const std::string& folder);

/// Prints JSON or the table. @return the command's exit status: failed where a row is not within its bounds.
int print_rows(const ExperimentReport& rows, bool as_json);

}  // namespace sprung::commands
