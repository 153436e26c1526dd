#include "tools/lab/bench/up_bench.h"

#include <unistd.h>

#include <algorithm>
#include <random>

#include "runtime/session_clock.h"
#include "tools/lab/bench/stopwatch.h"
#include "tools/operate/launcher/launcher.h"

namespace sprung {
namespace {

constexpr double kReach_s = 2.0;  // issue 7, "Measured"

int any_port() {
  std::random_device device;
  return 20000 + static_cast<int>(device() % 40000);
}

LaunchRequest request_for(const RobotConfig& robot, const std::string& log_folder) {
  LaunchRequest request;
  request.robot = robot.folder;
  request.simulation = true;
  request.lcm_url = lcm_url_on_port(any_port());
  request.instance = "bench-" + std::to_string(getpid());
  request.log_folder = log_folder;
  for (const BusConfig& bus : robot.buses)
    request.can.push_back(bus.name + "=udp:239.74.163.2:" + std::to_string(any_port()));
  return request;
}

struct Times {
  double ready_s = 0.0;
  double stop_s = 0.0;
};

Times time_one(const RobotConfig& robot, const std::string& log_folder) {
  const auto seconds_since = [](std::int64_t begin_us) {
    return static_cast<double>(monotonic_us() - begin_us) * 1e-6;
  };
  const std::int64_t begin_us = monotonic_us();
  Launcher launcher(request_for(robot, log_folder), robot);
  launcher.on_line([](const LogLine&) {});
  launcher.start_all_but_bridge();
  launcher.start_bridge();
  Times times;
  times.ready_s = seconds_since(begin_us);
  const std::int64_t stop_us = monotonic_us();
  launcher.stop();
  times.stop_s = seconds_since(stop_us);
  return times;
}

}  // namespace

std::vector<ReportRow> bench_up(const RobotConfig& robot, int runs, const std::string& log_folder) {
  std::vector<double> ready_s, stop_s;
  for (int run = 0; run < runs; ++run) {
    const Times times = time_one(robot, log_folder);
    ready_s.push_back(times.ready_s);
    stop_s.push_back(times.stop_s);
  }
  const std::string prefix = "up." + robot.name + ".";
  return {row(prefix + "ready", "s", median(ready_s), at_most(kReach_s)),
          row(prefix + "ready_slowest", "s", *std::max_element(ready_s.begin(), ready_s.end())),
          row(prefix + "stop", "s", median(stop_s))};
}

}  // namespace sprung
