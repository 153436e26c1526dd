/// sprung-can-bridge: CAN drives on one side, DRIVE_STATE and DRIVE_COMMAND on the other.
#include "drivers/bridge/bridge_shell.h"
#include "drivers/bridge/bus_load_check.h"
#include "runtime/log.h"

namespace sprung {
namespace {

/// Says how full the buses can get. @throws std::invalid_argument when that is too much.
void say_bus_load(const Process& process) {
  const RobotConfig& robot = process.robot();
  const BusLoadReport report = bus_load(robot, process.watchdogs());
  for (const BusLoad& bus : report.buses) log_info(bus_load_text(robot, bus));
  check_bus_load(robot, report);
}

}  // namespace
}  // namespace sprung

int main(int argc, char** argv) {
  sprung::BridgeProgramOptions options;
  const auto more_options = [&](sprung::CommandLine& line) {
    line.option("--inject-can", options.inject_can,
                "test of the lock-step link: can-drop:TICK:INDEX or can-repeat:TICK:INDEX");
    line.option("--can", options.can,
                "BUS=ADDRESS instead of robot.yaml's, e.g. leg=socketcan:can0; may be repeated");
    line.option("--cycles", options.cycles,
                "bring the drives to rest and end after that many cycles, 0 = never");
    line.option("--speed", options.speed,
                "lock-step: at most so many times real time, 0 = as fast as it goes");
  };
  const auto body = [&](sprung::Process& process) {
    sprung::say_bus_load(process);
    return process.lockstep() ? sprung::run_bridge_lockstep(process, options)
                              : sprung::run_bridge_realtime(process, options);
  };
  return sprung::run_process(argc, argv,
                             {"sprung-can-bridge", "Drives on CAN to LCM and back, with the robot's safety."},
                             body, more_options);
}
