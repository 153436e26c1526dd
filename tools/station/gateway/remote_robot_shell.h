#pragma once
/// A robot on another computer, as if it were up on this one, so that `sprung --via HOST stand`, `status` and
/// `console` are what they always are.
#include <string>

#include "tools/station/gateway/operator_link_shell.h"
#include "tools/station/gateway/robot_mirror_shell.h"

namespace sprung::gateway {

/// Stops the robot at once, before anything else is asked of it: `estop` every 20 ms from the first datagram
/// that a conversation allows. @return what the robot answered; empty: nobody did in 10 s. @throws as
/// OperatorLink.
std::string stop_in_emergency(const RemoteOptions& options);

class RemoteRobot {
 public:
  /// The link is there, and SPRUNG_RUN_DIR leads to the robot. @throws as OperatorLink and RobotMirror.
  explicit RemoteRobot(const RemoteOptions& options);

  /// Another operator drives from now on. @throws std::runtime_error where that is not so within 3 s.
  void hand_over(const std::string& name);

 private:
  OperatorLink link_;
  RobotMirror mirror_;
};

}  // namespace sprung::gateway
