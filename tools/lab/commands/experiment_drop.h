#pragma once
/// `sprung experiment drop`.
#include "runtime/command_line.h"

namespace sprung::commands {

void add_drop_experiment(CommandLine& experiment);

}  // namespace sprung::commands
