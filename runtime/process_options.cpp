#include "runtime/process_options.h"

#include <charconv>
#include <cstdlib>
#include <cstring>

#include "runtime/key_source.h"

namespace sprung {
namespace {

/// -1: nobody handed one on.
int key_fd_of_environment() {
  const char* const text = std::getenv(kKeyFdVariable);
  int fd = -1;
  if (text != nullptr) std::from_chars(text, text + std::strlen(text), fd);
  return fd;
}

bool is_simulated(const ProcessOptions& options) {
  return options.simulation || options.clock_mode() == ClockMode::kLockstep;
}

}  // namespace

ClockMode ProcessOptions::clock_mode() const noexcept {
  return value_named<ClockMode>(clock).value_or(ClockMode::kRealTime);
}

RealTimeRequest ProcessOptions::real_time() const noexcept {
  const RealTimePolicy policy = value_named<RealTimePolicy>(rt_policy).value_or(RealTimePolicy::kWarn);
  if (clock_mode() == ClockMode::kLockstep || policy == RealTimePolicy::kOff)
    return {RealTimePolicy::kOff, 0, -1};
  return {policy, priority, cpu};
}

void add_process_options(CommandLine& line, ProcessOptions& options) {
  line.option("--robot", options.robot, "robot, by name or folder");
  line.option("--preset", options.preset, "which of the robot's presets; default: best, else the only one");
  line.option("--session", options.node.session, "number of this session; messages of others are refused",
              Need::kRequired);
  line.option("--epoch-us", options.node.epoch_us, "CLOCK_MONOTONIC when the session began, us; 0 = at boot");
  line.option("--lcm-url", options.node.lcm_url, "on-robot LCM network");
  line.choice("--clock", options.clock, names_of<ClockMode>(), "who paces the cycle");
  line.choice("--rt-policy", options.rt_policy, names_of<RealTimePolicy>(),
              "when real-time scheduling is refused");
  line.option("--priority", options.priority, "SCHED_FIFO priority, 0 = normal scheduling");
  line.option("--cpu", options.cpu, "pin to this CPU, -1 = any");
  line.option("--inject", options.node.inject,
              "link fault: drop-rx|drop-tx|repeat-tx:CHANNEL:SEQ (for tests)");
  line.option("--key-fd", options.key_fd, "open descriptor with the run's key; -1 = $SPRUNG_KEY_FD");
  line.flag("--no-key", options.no_key, "believe every message (for tests: lock-step or --simulation)");
  line.flag("--simulation", options.simulation,
            "real time on a shared machine: the robot's simulation_watchdogs");
  line.flag("--maintenance", options.maintenance,
            "reduced speed and torque, and nothing moves that nobody holds");
}

void refuse_injection(const ProcessOptions& options) {
  if (options.node.inject.empty() || is_simulated(options)) return;
  throw WrongUse("--inject makes faults for tests: only in lock-step, or with --simulation");
}

std::shared_ptr<const MessageKey> key_of(const ProcessOptions& options) {
  if (options.no_key && !is_simulated(options))
    throw WrongUse(
        "--no-key lets anybody on the network move the drives: only in lock-step, or with --simulation");
  if (options.no_key) return nullptr;
  const int fd = options.key_fd >= 0 ? options.key_fd : key_fd_of_environment();
  if (fd >= 0) return read_key_fd(fd);
  throw WrongUse(
      "there is no key, without which nothing is believed and nobody believes this program: start it by "
      "sprung up (robot.yaml's processes), or sprung run -- PROGRAM; for tests in lock-step --no-key");
}

const WatchdogConfig& watchdogs_for(const RobotConfig& robot, const ProcessOptions& options) noexcept {
  const bool longer = options.simulation && options.clock_mode() == ClockMode::kRealTime;
  return longer ? robot.simulation_watchdogs : robot.watchdogs;
}

// FNV-1a, continued from the files' hashes over the preset's name; another one in maintenance mode.
std::int64_t configuration_hash(const RobotConfig& robot, const std::string& preset) noexcept {
  auto hash = static_cast<std::uint64_t>(robot.hash) ^ 0xcbf29ce484222325U;
  if (robot.hold_to_run) hash ^= 1U;
  hash ^= static_cast<std::uint64_t>(robot.overlay_hash);
  for (const char c : preset) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return static_cast<std::int64_t>(hash);
}

}  // namespace sprung
