#pragma once
/// `sprung experiment foot_return`, `step_response` and `stand_push`.
#include "runtime/command_line.h"

namespace sprung::commands {

void add_leg_experiments(CommandLine& experiment);

}  // namespace sprung::commands
