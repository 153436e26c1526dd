#pragma once
/// `sprung experiment estimator`.
#include "runtime/command_line.h"

namespace sprung::commands {

void add_estimator_experiment(CommandLine& experiment);

}  // namespace sprung::commands
