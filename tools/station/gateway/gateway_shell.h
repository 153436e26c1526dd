#pragma once
/// The gateway's process: datagrams of operators elsewhere into the gate, what it lets in to the robot, what
/// the robot says out again. It lives as long as it is wanted; robots come and go.
#include <functional>
#include <string>

#include "tools/station/gateway/udp_socket_shell.h"

namespace sprung::gateway {

struct GatewayOptions {
  std::string instance = "default";
  HostPort listen;
  std::string state_folder;  ///< register, own key, audit log
  std::string log_folder;    ///< that operators may fetch of; empty: the one that the run logs to
};

/// Until a stop is asked for. @param ready is told once it hears. @throws std::runtime_error as its parts do.
void serve_operators(const GatewayOptions& options, const std::function<void(int port)>& ready);

}  // namespace sprung::gateway
