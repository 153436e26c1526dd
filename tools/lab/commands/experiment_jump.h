#pragma once
/// `sprung experiment jump` and `sprung experiment jump_ensemble`.
#include "runtime/command_line.h"

namespace sprung::commands {

void add_jump_experiments(CommandLine& experiment);

}  // namespace sprung::commands
