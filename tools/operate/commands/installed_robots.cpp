#include "tools/operate/commands/installed_robots.h"

#include <cstdlib>
#include <filesystem>

namespace sprung::commands {

void use_installed_robots(const std::string& program_folder) {
  namespace fs = std::filesystem;
  const fs::path robots = fs::path(program_folder).parent_path() / "share/sprung/robots";
  std::error_code none;
  const char* const asked = std::getenv("SPRUNG_ROBOTS");
  const bool free = asked == nullptr || *asked == '\0';
  if (free && fs::is_directory(robots, none)) setenv("SPRUNG_ROBOTS", robots.c_str(), 1);
}

}  // namespace sprung::commands
