#pragma once
/// The overlay with which a run began, beside its run file, for all of its processes: one that is started
/// again after `sprung param save` is then still what the others are. Writes a file and this process's
/// environment.
#include <string>

#include "robots/robot_config.h"

namespace sprung {

class KeptOverlay {
 public:
  /// To be made once the instance is ours. @throws std::runtime_error where it cannot be written.
  KeptOverlay(const std::string& instance, const RobotConfig& robot);
  ~KeptOverlay();
  KeptOverlay(const KeptOverlay&) = delete;
  KeptOverlay& operator=(const KeptOverlay&) = delete;

 private:
  std::string path_;
};

}  // namespace sprung
