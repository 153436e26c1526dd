/// sprung-operator-gateway: the one thing on a robot that other computers reach.
#include <filesystem>
#include <string>

#include "runtime/command_line.h"
#include "runtime/log.h"
#include "runtime/stop_request.h"
#include "tools/station/gateway/gateway_shell.h"
#include "tools/station/gateway/operator_register_shell.h"
#include "tools/station/gateway/packets.h"

int main(int argc, char** argv) {
  using namespace sprung;
  start_log("sprung-operator-gateway");
  install_stop_signals();
  std::string listen = "0.0.0.0:" + std::to_string(gateway::kDefaultPort), instance = "default", logs;
  CommandLine line("sprung-operator-gateway",
                   "Lets operators on other computers command the robot of this one, each by his own key.");
  line.option("--listen", listen, "ADDRESS or ADDRESS:PORT of this computer, UDP; port 0 = any that is free");
  line.option("--instance", instance, "which run; the gateway waits until it is up");
  line.option("--logs", logs, "folder that operators may fetch logs of; default: where the run logs");
  line.example("sprung-operator-gateway --listen 192.168.1.10");
  line.action([&] {
    const std::string folder = std::filesystem::path(gateway::register_path()).parent_path();
    gateway::serve_operators(
        {instance, gateway::parse_host_port(listen, gateway::kDefaultPort), folder, logs},
        [&](int port) { log_info("operators are heard on UDP port " + std::to_string(port)); });
    return kExitDone;
  });
  return line.run(argc, argv);
}
