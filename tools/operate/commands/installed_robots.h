#pragma once
/// Where an installed sprung finds robots by name.
#include <string>

namespace sprung::commands {

/// Sets $SPRUNG_ROBOTS, for this process and those that it starts, to share/sprung/robots beside the folder
/// of the program, where there is one and nobody has set it. A program in its build folder uses the source
/// tree's.
void use_installed_robots(const std::string& program_folder);

}  // namespace sprung::commands
