#pragma once
/// `sprung experiment foot_return` and `step_response`.
#include "runtime/command_line.h"

namespace sprung::commands {

void add_leg_experiments(CommandLine& experiment);

}  // namespace sprung::commands
