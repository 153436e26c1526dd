#pragma once
/// A robot on another computer, as if it were up on this one: what its gateway tells is said again on an LCM
/// network of this process's own, with a run file and a key of its own, and commands that are heard there go
/// to the gateway, signed. So `sprung --via HOST stand`, `status` and `console` are what they always are.
#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "tools/station/gateway/operator_register.h"
#include "tools/station/gateway/packets.h"
#include "tools/station/gateway/udp_socket_shell.h"

namespace sprung::gateway {

struct RemoteOptions {
  std::string host;  ///< HOST or HOST:PORT
  std::string key;   ///< file of the operator's key
  bool hidden = false;
};

/// Stops the robot at once, before anything else is asked of it: `estop` every 20 ms from the first datagram
/// that a conversation allows. @return what the robot answered; empty: nobody did in 10 s. @throws as
/// RemoteRobot.
std::string stop_in_emergency(const RemoteOptions& options);

class RemoteRobot {
 public:
  /// The link is there, and SPRUNG_RUN_DIR leads to the robot. @throws std::runtime_error saying what to do
  /// where nobody answers, or does not want this operator; NotRunning where no robot is up.
  explicit RemoteRobot(const RemoteOptions& options);
  ~RemoteRobot();
  RemoteRobot(const RemoteRobot&) = delete;
  RemoteRobot& operator=(const RemoteRobot&) = delete;

  /// Another operator drives from now on. @throws std::runtime_error where that is not so within 3 s.
  void hand_over(const std::string& name);

 private:
  friend std::string stop_in_emergency(const RemoteOptions& options);
  static std::string emergency(const RemoteOptions& options);
  class Link;
  class Mirror;
  std::unique_ptr<Link> link_;
  std::unique_ptr<Mirror> mirror_;
};

}  // namespace sprung::gateway
