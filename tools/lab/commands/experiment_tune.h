#pragma once
/// `sprung experiment tune`.
#include "runtime/command_line.h"

namespace sprung::commands {

void add_tune_experiment(CommandLine& experiment);

}  // namespace sprung::commands
