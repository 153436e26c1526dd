#pragma once
/// The manual page, roff of section 1, made from the commands themselves. Pure.
#include <string>

#include "runtime/command_info.h"

namespace sprung {

std::string man_page(const CommandInfo& program, const std::string& version);

/// Text as roff shows it: backslashes, hyphens that can be copied, and a dot or quote at a line's begin.
std::string roff_text(const std::string& text);

}  // namespace sprung
