#pragma once
/// What `sprung replay --diff` and `sprung log diff` share.
#include <string>

#include "tools/logs/replay/log_diff.h"

namespace sprung::commands {

/// Prints it; a page too where `html` names a file. @return exit status: 1 where the logs differ.
int run_diff(DiffRequest request, const std::string& html);

}  // namespace sprung::commands
