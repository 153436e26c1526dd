#include "tools/launcher/run_description.h"

#include <unistd.h>

#include <array>
#include <ctime>
#include <filesystem>
#include <random>
#include <stdexcept>

#include "runtime/session_clock.h"
#include "tools/launcher/lead_finder.h"

namespace sprung {

namespace fs = std::filesystem;

std::int64_t random_session() {
  std::random_device device;
  return static_cast<std::int64_t>((static_cast<std::uint64_t>(device()) << 32 | device()) >> 1) | 1;
}

std::string lcm_url_on_port(int port) {
  return "udpm://239.255.76.67:" + std::to_string(port) + "?ttl=0&recv_buf_size=4194304";
}

RunInfo describe_run(const LaunchRequest& request, const RobotConfig& robot) {
  RunInfo info;
  info.instance = request.instance;
  info.robot = robot.name;
  info.robot_folder = robot.folder;
  info.preset = request.preset;
  info.clock = request.clock;
  info.simulation = request.simulation;
  info.session = random_session();
  info.epoch_us = monotonic_us();
  info.lcm_url = request.lcm_url;
  info.can = request.can;
  info.launcher_pid = getpid();
  return info;
}

RunInfo describe_joined_run(const LaunchRequest& request, const RobotConfig& robot) {
  RunInfo info = describe_run(request, robot);
  const auto lead = find_lead(request.lcm_url, robot.name, request.patience_s);
  if (!lead)
    throw std::runtime_error(
        "no `sprung up " + robot.name + "` with the bridge is heard on " + request.lcm_url +
        ": start it on the host that has the buses, with an --lcm-url whose ttl is 1 on every "
        "host; sprung doctor tests the network");
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
  std::string path = base + ".lcm";
  for (int again = 2; fs::exists(path); ++again) path = base + "-" + std::to_string(again) + ".lcm";
  return path;
}

std::string lines_path(const std::string& log) { return fs::path(log).replace_extension(".txt").string(); }

}  // namespace sprung
