#pragma once
/// What is in a log, for people and for scripts. Pure.
#include <string>

#include "tools/logs/log/log_info.h"

namespace sprung::log {

struct InfoTextOptions {
  bool every_incident = false;  ///< else no events of legs, only how many, and at most a screen of the others
};

std::string info_text(const LogInfo& info, const InfoTextOptions& options = {});

/// One JSON object: all that info_text says, incidents too, and robot.yaml as text.
std::string info_json(const LogInfo& info);

}  // namespace sprung::log
