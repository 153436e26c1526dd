#pragma once
/// Commands as data, for scripts and tests.
#include <string>

#include "runtime/command_info.h"

namespace sprung {

std::string command_json(const CommandInfo& program);

}  // namespace sprung
