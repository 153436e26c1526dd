#include "tools/operate/launcher/kept_overlay.h"

#include <cstdlib>
#include <filesystem>

#include "robots/overlay.h"
#include "runtime/private_file.h"
#include "tools/operate/launcher/run_folder.h"

namespace sprung {

KeptOverlay::KeptOverlay(const std::string& instance, const RobotConfig& robot)
    : path_(made_run_folder() / (instance + ".overlay.yaml")) {
  write_private_file(path_, overlay_text(robot.overlay));
  setenv(kOverlayVariable, path_.c_str(), 1);
}

KeptOverlay::~KeptOverlay() {
  unsetenv(kOverlayVariable);
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace sprung
