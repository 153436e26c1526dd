/// What an operator's open link does to a robot elsewhere, again and again, for measure_remote: emergency
/// stops at random moments, each with the time at which it was said (CLOCK_MONOTONIC, us), or a walk that is
/// begun again whenever it ended.
///   remote_probe HOST:PORT KEY estop COUNT SEED
///   remote_probe HOST:PORT KEY walk SECONDS SEED
#include <chrono>
#include <cstdio>
#include <random>
#include <string>
#include <thread>

#include "robots/robot_loader.h"
#include "runtime/session_clock.h"
#include "runtime/stop_request.h"
#include "tools/operate/client/operator_client.h"
#include "tools/station/gateway/remote_robot_shell.h"

namespace sprung {
namespace {

void sleep_s(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

OperatorCommand command_of(OperatorKind kind) {
  OperatorCommand out;
  out.kind = kind;
  return out;
}

bool done(OperatorClient& client, OperatorKind kind) {
  OperatorCommand command = command_of(kind);
  const auto answer = client.send(command, 15.0);
  if (answer && answer->outcome == OperatorOutcome::kDone) return true;
  if (!answer || answer->outcome != OperatorOutcome::kAccepted) return false;
  const auto end = client.wait_done(command, 15.0);
  return end && end->outcome == OperatorOutcome::kDone;
}

int stop_again_and_again(OperatorClient& client, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> pause_s(0.3, 1.5);
  for (int k = 0; k < count && !stop_requested(); ++k) {
    sleep_s(pause_s(random));
    OperatorCommand stop = command_of(OperatorKind::kEstop);
    std::printf("estop %lld\n", static_cast<long long>(monotonic_us()));
    if (!client.send(stop, 15.0)) std::printf("unanswered\n");
    while (!done(client, OperatorKind::kClear) && !stop_requested()) sleep_s(0.3);
    std::fflush(stdout);
  }
  return 0;
}

/// A hold every tenth of a second, as a page that is open.
int walk_on(OperatorClient& client, const RobotConfig& robot, double seconds) {
  int trot = 0;
  for (std::size_t i = 0; i < robot.gaits.size(); ++i)
    if (robot.gaits[i].name == "trot") trot = static_cast<int>(i);
  const std::int64_t end_us = monotonic_us() + static_cast<std::int64_t>(1e6 * seconds);
  while (monotonic_us() < end_us && !stop_requested()) {
    OperatorCommand walk = command_of(OperatorKind::kWalk);
    walk.gait = trot;
    walk.walk_speed = {0.3, 0.0, 0.0};
    walk.hold_s = 1.0;
    const auto answer = client.send(walk, 3.0);
    if (!answer || answer->outcome != OperatorOutcome::kAccepted) {
      std::printf("not yet: %s\n", answer ? answer->reason.c_str() : "no answer");
      std::fflush(stdout);
      sleep_s(0.5);
      continue;
    }
    std::printf("walk %lld\n", static_cast<long long>(monotonic_us()));
    std::fflush(stdout);
    while (monotonic_us() < end_us && !stop_requested()) {
      OperatorCommand hold = command_of(OperatorKind::kHold);
      hold.hold_s = 1.0;
      const auto held = client.send(hold, 3.0);
      if (held && held->outcome == OperatorOutcome::kRefused) break;  // it stands: again
      sleep_s(0.1);
    }
  }
  std::printf("end %lld\n", static_cast<long long>(monotonic_us()));
  return 0;
}

}  // namespace
}  // namespace sprung

int main(int argc, char** argv) {
  using namespace sprung;
  if (argc != 6) {
    std::fprintf(stderr, "usage: remote_probe HOST:PORT KEY estop|walk COUNT|SECONDS SEED\n");
    return 2;
  }
  install_stop_signals();
  try {
    gateway::RemoteRobot robot({argv[1], argv[2], false});
    const RunInfo info = require_running("default", "");
    OperatorClient client(info);
    std::printf("ready\n");
    std::fflush(stdout);
    return argv[3] == std::string("estop")
               ? stop_again_and_again(client, std::stoi(argv[4]), static_cast<unsigned>(std::stoul(argv[5])))
               : walk_on(client, load_robot(info.robot_folder), std::stod(argv[4]));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "remote_probe: %s\n", error.what());
    return 1;
  }
}
