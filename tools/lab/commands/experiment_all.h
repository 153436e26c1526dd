#pragma once
/// `sprung experiment all`.
#include "runtime/command_line.h"

namespace sprung::commands {

void add_all_experiments(CommandLine& experiment);

}  // namespace sprung::commands
