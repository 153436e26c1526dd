#pragma once
/// A robot steered by a gamepad, without a page: the same session, with one page that is this program.
#include <functional>
#include <string>

#include "tools/operate/launcher/run_file.h"

namespace sprung::station {

struct DriveByOptions {
  std::string device;  ///< as GamepadDevice
  std::string gait;    ///< name; "" = the fastest that steps
};

/// Until a stop is requested or the gamepad is gone; the robot then stands. @param tell is called with lines
/// for the operator.
/// @return why it ended: "" on a stop request. @throws std::runtime_error or std::invalid_argument where it
/// cannot begin, saying why.
std::string drive_by_gamepad(const RunInfo& info, const DriveByOptions& options,
                             const std::function<void(const std::string&)>& tell);

}  // namespace sprung::station
