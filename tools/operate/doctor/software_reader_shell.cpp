#include "tools/operate/doctor/software_reader_shell.h"

#include <lcm/lcm.h>
#include <sprung_version.h>

#include <stdexcept>

#include "lcmtypes/channels.h"
#include "robots/maintenance.h"
#include "robots/robot_loader.h"
#include "runtime/node.h"
#include "runtime/process_options.h"
#include "runtime/process_status.h"
#include "runtime/types_hash.h"
#include "tools/operate/launcher/build_match.h"
#include "tools/operate/launcher/child_process.h"
#include "tools/operate/launcher/run_file.h"

namespace sprung::doctor {
namespace {

constexpr double kVersion_s = 2.0;
constexpr std::int64_t kListen_us = 700'000;  // PROCESS_STATUS comes twice a second

bool has_program(const std::string& name, const std::string& package) {
  try {
    return !system_program(name, package).empty();
  } catch (const std::runtime_error&) {
    return false;
  }
}

/// Sentences about processes of this run that do not belong to this program.
std::vector<std::string> strangers_of(const RunInfo& info) {
  RobotConfig robot = load_robot(info.robot_folder);
  if (info.maintenance) robot = for_maintenance(std::move(robot));
  const BuildIdentity ours{SPRUNG_VERSION, SPRUNG_GIT_HASH,
                           types_hash(),   configuration_hash(robot, info.preset),
                           robot.name,     info.clock};
  InputQueue<sprung_msgs::process_status_t> statuses(256);
  Node node(NodeOptions{info.lcm_url, info.session, info.epoch_us, {}});
  node.subscribe_message(channels::kProcessStatus, CountLimits::none(), statuses);
  const Receiving receiving(node);
  std::vector<std::string> strangers;
  const std::int64_t end_us = node.utime_us() + kListen_us;
  while (node.utime_us() < end_us) {
    node.wait_for_input(end_us);
    while (auto status = statuses.pop()) {
      const std::string why = why_not_together(ours, *status, false);
      if (!why.empty()) strangers.push_back(why);
    }
  }
  if (node.refused_messages() > 0) strangers.push_back(node.last_refusal());
  return strangers;
}

}  // namespace

std::string program_version(const std::string& path) {
  std::string text;
  try {
    ChildProcess program(path, {"--version"}, Output::kCaptured);
    if (!program.wait(kVersion_s)) program.stop(0.0);
    text = program.output();
  } catch (const std::runtime_error&) {
    return "";
  }
  const std::size_t blank = text.find(' ');
  if (blank == std::string::npos || text.back() != '\n') return "";
  return text.substr(blank + 1, text.size() - blank - 2);
}

SoftwareFacts read_software(const std::string& folder, const std::vector<std::string>& programs,
                            const std::string& instance) {
  SoftwareFacts facts;
  facts.lcm_version = std::to_string(LCM_MAJOR_VERSION) + "." + std::to_string(LCM_MINOR_VERSION) + "." +
                      std::to_string(LCM_MICRO_VERSION);
  facts.has_lcm_gen = has_program("lcm-gen", "liblcm-bin") && has_program("lcm-logger", "liblcm-bin");
  facts.own_version = std::string(SPRUNG_VERSION) + " (" + SPRUNG_GIT_HASH + ")";
  facts.types_hash = types_hash();
  for (const std::string& program : programs)
    facts.programs[program] = program_version(folder + "/" + program);
  if (const auto info = read_run_file(instance)) {
    facts.robot_is_up = true;
    facts.strangers = strangers_of(*info);
  }
  return facts;
}

}  // namespace sprung::doctor
