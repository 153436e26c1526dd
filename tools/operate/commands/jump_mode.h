#pragma once
/// The option `--mode` of commands that jump.
#include <string>
#include <vector>

#include "signals/modes.h"

namespace sprung::commands {

/// What --mode may be.
const std::vector<std::string>& jump_mode_names();

/// @throws WrongUse where there is no mode of this name.
JumpMode jump_mode(const std::string& name);

}  // namespace sprung::commands
