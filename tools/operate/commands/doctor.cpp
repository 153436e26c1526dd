#include <cstdio>
#include <memory>

#include "drivers/can/bus_addresses.h"
#include "robots/robot_loader.h"
#include "runtime/node.h"
#include "runtime/own_port.h"
#include "tools/commands.h"
#include "tools/operate/doctor/loopback_probe_shell.h"
#include "tools/operate/doctor/machine_reader_shell.h"
#include "tools/operate/doctor/network_checks.h"
#include "tools/operate/doctor/real_time_checks.h"
#include "tools/operate/doctor/robot_checks.h"
#include "tools/operate/doctor/software_reader_shell.h"
#include "tools/operate/launcher/child_process.h"
#include "tools/operate/launcher/recorder_plan.h"

namespace sprung::commands {

namespace {

using doctor::Check;

constexpr int kLoopbackMessages = 200;

struct DoctorRequest {
  std::string robot = "single_leg";
  std::vector<std::string> can;
  std::string lcm_url = kDefaultLcmUrl;
  std::string log_folder = "logs";
  std::string instance = "default";
  bool as_json = false;
};

void append(std::vector<Check>& checks, const std::vector<Check>& more) {
  checks.insert(checks.end(), more.begin(), more.end());
}

std::vector<doctor::BusFacts> read_buses(const RobotConfig& robot) {
  std::vector<doctor::BusFacts> buses;
  for (const BusConfig& bus : robot.buses) {
    const std::string interface = interface_of(bus.can);
    if (!interface.empty()) buses.push_back({bus.name, interface, read_interface(bus.can)});
  }
  return buses;
}

std::vector<std::string> programs_of(const RobotConfig& robot) {
  std::vector<std::string> programs{kRecorderProgram, "sprung-sim-drives"};
  for (const ProcessConfig& process : robot.processes) programs.push_back(process.program);
  return programs;
}

int run_doctor(const DoctorRequest& request) {
  const RobotConfig robot = with_bus_addresses(load_robot(request.robot), request.can);
  const doctor::KernelFacts kernel = doctor::read_kernel("/");
  std::vector<Check> checks = doctor::network_checks(
      kernel, doctor::probe_loopback(request.lcm_url, own_port(), kLoopbackMessages), &robot);
  append(checks, doctor::real_time_checks(kernel, doctor::read_limits(), doctor::read_utc(), &robot));
  append(checks, doctor::can_checks(read_buses(robot), robot));
  append(checks, doctor::software_checks(
                     doctor::read_software(program_folder(), programs_of(robot), request.instance)));
  checks.push_back(doctor::disk_check(doctor::read_disk(request.log_folder)));
  std::printf("%s", (request.as_json ? doctor::as_json(checks) : doctor::as_text(checks)).c_str());
  return doctor::worst(checks) == doctor::Verdict::kFail ? kExitFailed : kExitDone;
}

}  // namespace

void add_doctor(CommandLine& sprung) {
  const auto request = std::make_shared<DoctorRequest>();
  CommandLine& doctor = sprung.subcommand(
      "doctor", "Whether this machine is fit to run a robot, and the command that mends what is not.");
  doctor.option("--robot", request->robot, "name or folder: its buses, priorities and CPUs are looked at");
  doctor.option("--can", request->can, "BUS=ADDRESS instead of robot.yaml's; may be repeated");
  doctor.option("--lcm-url", request->lcm_url, "LCM network, tested on another port of the same group");
  doctor.option("--log", request->log_folder, "folder that logs go to: its disk is looked at");
  doctor.option("--instance", request->instance, "run whose processes are compared, if it is up");
  doctor.flag("--json", request->as_json, "one JSON object; exit status 1 where a check fails");
  doctor.example("sprung doctor --robot pegasus --can front_left=socketcan:can0");
  doctor.action([=] { return run_doctor(*request); });
}

}  // namespace sprung::commands
