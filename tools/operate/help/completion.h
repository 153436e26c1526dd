#pragma once
/// What bash offers after `sprung <TAB>`: a script made from the commands themselves. Pure.
#include <string>
#include <vector>

#include "runtime/command_info.h"

namespace sprung {

/// @param robots names that a robot's place is completed with, beside folders.
std::string bash_completion(const CommandInfo& program, const std::vector<std::string>& robots);

/// "--count" of "-c,--count": the longest name of an option.
std::string long_name(const OptionInfo& option);
/// "-c" and "--count" of "-c,--count".
std::vector<std::string> names_of(const OptionInfo& option);

}  // namespace sprung
