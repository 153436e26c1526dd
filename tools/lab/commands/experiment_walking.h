#pragma once
/// `sprung experiment walk`, `ground_error`, `push` and `endurance`: of robots on legs.
#include "runtime/command_line.h"

namespace sprung::commands {

void add_walking_experiments(CommandLine& experiment);

}  // namespace sprung::commands
