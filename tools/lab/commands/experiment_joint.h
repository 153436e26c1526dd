#pragma once
/// `sprung experiment friction_sweep` and `sprung experiment drag`.
#include "runtime/command_line.h"

namespace sprung::commands {

void add_joint_experiments(CommandLine& experiment);

}  // namespace sprung::commands
