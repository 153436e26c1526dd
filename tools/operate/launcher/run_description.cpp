#include "tools/operate/launcher/run_description.h"

#include <unistd.h>

#include <array>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <random>
#include <stdexcept>

#include "drivers/can/bus_addresses.h"
#include "runtime/session_clock.h"
#include "tools/operate/launcher/lead_finder.h"

namespace sprung {

namespace fs = std::filesystem;

std::int64_t random_session() {
  std::random_device device;
  constexpr unsigned kExactInDoubles = 53;  // Lua, JavaScript and jq then read the number that stands there
  const std::uint64_t bits = static_cast<std::uint64_t>(device()) << 32 | device();
  return static_cast<std::int64_t>(bits >> (64 - kExactInDoubles)) | 1;
}

std::string lcm_url_on_port(int port) {
  return "udpm://239.255.76.67:" + std::to_string(port) + "?ttl=0&recv_buf_size=4194304";
}

RunInfo describe_run(const LaunchRequest& request, const RobotConfig& robot) {
  RunInfo info;
  info.instance = request.instance;
  info.robot = robot.name;
  info.robot_folder = fs::canonical(robot.folder).string();  // read by commands in any working folder
  info.preset = robot.preset(request.preset).name;
  info.clock = request.clock;
  info.simulation = request.simulation;
  info.plant = request.plant;
  info.maintenance = request.maintenance;
  info.session = random_session();
  info.epoch_us = monotonic_us();
  info.lcm_url = request.lcm_url;
  info.can = request.can;
  if (leads(request, robot)) info.buses = bus_addresses(robot, request.can);
  info.launcher_pid = getpid();
  return info;
}

namespace {

/// What a message may have waited, and far more than ages may be wrong by.
constexpr std::int64_t kClocksDiffer_us = 1'000'000;

void require_same_time(const sprung_msgs::process_status_t& lead) {
  const std::int64_t ahead_us = utc_us() - (lead.utime + lead.utc_offset_us);
  if (std::abs(ahead_us) <= kClocksDiffer_us) return;
  throw std::runtime_error(
      "the clock of this host and that of " + lead.host + ", which has the bridge, are " +
      std::to_string(std::abs(ahead_us) / 1'000'000) +
      " s apart, and ages are measured across them: synchronise both (chrony, or better linuxptp); "
      "sprung doctor looks");
}

}  // namespace

RunInfo describe_joined_run(const LaunchRequest& request, const RobotConfig& robot) {
  RunInfo info = describe_run(request, robot);
  std::string refusal;
  const auto lead = find_lead(request.lcm_url, robot.name, request.timeout_s, &refusal);
  if (!lead && !refusal.empty())
    throw std::runtime_error("what is heard on " + request.lcm_url + " cannot be read: " + refusal +
                             "; build and install the same commit on every host");
  if (!lead)
    throw std::runtime_error(
        "no `sprung up " + robot.name + "` with the bridge is heard on " + request.lcm_url +
        ": start it on the host that has the buses, with an --lcm-url whose ttl is 1 on every "
        "host; sprung doctor tests the network");
  require_same_time(*lead);
  info.session = lead->session;
  info.epoch_us = epoch_here_us(lead->utc_offset_us, utc_us(), monotonic_us());
  return info;
}

std::string log_path(const std::string& folder, const std::string& robot) {
  fs::create_directories(folder);
  std::array<char, 32> when{};
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  std::strftime(when.data(), when.size(), "%Y%m%d-%H%M%S", &local);
  const std::string base = (fs::absolute(folder) / (robot + "-" + when.data())).string();
  std::string name = base;
  const auto taken = [&name] {  // also by the lines, and by the parts of a recording that was split
    return fs::exists(name + ".lcm") || fs::exists(name + ".txt") || fs::exists(name + "-000.lcm");
  };
  for (int again = 2; taken(); ++again) name = base + "-" + std::to_string(again);
  return name + ".lcm";
}

std::string lines_path(const std::string& log) { return fs::path(log).replace_extension(".txt").string(); }

}  // namespace sprung
