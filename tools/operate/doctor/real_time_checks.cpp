#include "tools/operate/doctor/real_time_checks.h"

#include <algorithm>
#include <cstdio>
#include <set>

namespace sprung::doctor {
namespace {

// A process of pegasus locks about 60 MB; torch and ROS users know limits of 64 kB.
constexpr std::int64_t kMemlock_bytes = 256LL << 20U;
// Processes on two hosts compare stamps with ages of a few ms.
constexpr double kUtcError_ms = 2.0;

template <class Cpus>
std::string join(const Cpus& cpus) {
  std::string text;
  for (const int cpu : cpus) text += (text.empty() ? "" : ",") + std::to_string(cpu);
  return text;
}

int highest_priority(const RobotConfig* robot) {
  int highest = 50;  // the simulated drives' and every shipped bridge's
  if (robot != nullptr)
    for (const ProcessConfig& process : robot->processes) highest = std::max(highest, process.priority);
  return highest;
}

std::set<int> pinned_cpus(const RobotConfig* robot) {
  std::set<int> cpus;
  if (robot != nullptr)
    for (const ProcessConfig& process : robot->processes)
      if (process.cpu >= 0) cpus.insert(process.cpu);
  return cpus;
}

std::string limits_line(const std::string& what) {
  return "echo \"$USER - " + what +
         "\" | sudo tee -a /etc/security/limits.d/60-sprung.conf; then log in again";
}

Check kernel_check(const KernelFacts& kernel) {
  if (kernel.real_time) return pass("kernel", "PREEMPT_RT");
  return warn("kernel", "not PREEMPT_RT: single cycles may come several ms late under load",
              "apt-get install linux-image-rt-amd64, and boot it");
}

Check priority_check(const LimitFacts& limits, int wanted) {
  const bool unlimited = limits.rtprio < 0;
  const std::string found = "rtprio " + (unlimited ? "unlimited" : std::to_string(limits.rtprio)) +
                            (limits.superuser ? ", root" : "");
  const bool allowed = limits.superuser || unlimited || limits.rtprio >= wanted;
  if (limits.fifo_granted && allowed) return pass("real-time priority", found);
  if (allowed)
    return warn("real-time priority",
                found + ", but the kernel refuses SCHED_FIFO: a container, or a cgroup without real-time",
                "run on the machine itself, or give the container --cap-add=SYS_NICE --ulimit rtprio=98");
  return warn("real-time priority", found + ", robot.yaml wants " + std::to_string(wanted),
              limits_line("rtprio 98"));
}

Check memlock_check(const LimitFacts& limits) {
  const bool enough = limits.superuser || limits.memlock_bytes < 0 || limits.memlock_bytes >= kMemlock_bytes;
  const std::string found = limits.memlock_bytes < 0 ? "unlimited"
                                                     : std::to_string(limits.memlock_bytes / 1024) + " kB";
  if (enough) return pass("locked memory", found + (limits.superuser ? ", root" : ""));
  return warn("locked memory", found + ": page faults can stop a loop", limits_line("memlock unlimited"));
}

Check governor_check(const KernelFacts& kernel) {
  if (kernel.governors.empty()) return pass("CPU frequency", "not scaled");
  for (const auto& [cpu, governor] : kernel.governors) {
    if (governor != "performance")
      return warn("CPU frequency", cpu + " has governor " + governor + ": loops run unevenly",
                  "echo performance | sudo tee /sys/devices/system/cpu/cpu*/cpufreq/scaling_governor");
  }
  return pass("CPU frequency", "performance on " + std::to_string(kernel.governors.size()) + " CPUs");
}

Check isolation_check(const KernelFacts& kernel, const std::set<int>& pinned) {
  if (pinned.empty())
    return pass("CPUs", std::to_string(kernel.cpus.size()) + ", robot.yaml pins no process");
  std::set<int> missing = pinned;
  for (const int cpu : kernel.cpus) missing.erase(cpu);
  if (!missing.empty())
    return fail("CPUs", "robot.yaml pins to CPU " + join(missing) + ", online are " + join(kernel.cpus),
                "set cpu: of its processes in robot.yaml to one of " + join(kernel.cpus) + ", or -1");
  std::set<int> shared = pinned;
  for (const int cpu : kernel.isolated_cpus) shared.erase(cpu);
  if (shared.empty()) return pass("CPUs", join(pinned) + " are isolated, as robot.yaml pins");
  return warn("CPUs", "robot.yaml pins to " + join(pinned) + ", of which others may use " + join(shared),
              "add isolcpus=" + join(pinned) + " nohz_full=" + join(pinned) +
                  " to GRUB_CMDLINE_LINUX in /etc/default/grub; update-grub; reboot");
}

Check clock_check(const KernelFacts& kernel) {
  const bool slow = kernel.clock_source == "hpet" || kernel.clock_source == "acpi_pm" ||
                    kernel.clock_source == "jiffies";
  if (!slow) return pass("clock", kernel.clock_source.empty() ? "not known" : kernel.clock_source);
  const auto& all = kernel.clock_sources;
  const bool has_tsc = std::find(all.begin(), all.end(), "tsc") != all.end();
  return warn("clock", kernel.clock_source + ": every reading costs about 1 us",
              has_tsc ? "echo tsc > /sys/devices/system/clocksource/clocksource0/current_clocksource"
                      : "boot with tsc=reliable; see dmesg | grep -i tsc");
}

Check utc_check(const UtcFacts& utc, const RobotConfig* robot) {
  const bool several = robot != nullptr &&
                       std::any_of(robot->processes.begin(), robot->processes.end(),
                                   [](const ProcessConfig& process) { return !process.host.empty(); });
  char found[64];
  std::snprintf(found, sizeof found, "%s, error up to %.1f ms",
                utc.synchronised ? "synchronised" : "not synchronised", utc.error_ms);
  const bool good = utc.synchronised && utc.error_ms <= kUtcError_ms;
  if (several && !good)
    return fail("UTC", std::string(found) + ": processes on several hosts compare their clocks",
                "apt-get install chrony on every host, one of them the others' server; better: linuxptp");
  if (!utc.synchronised)
    return warn("UTC", std::string(found) + ": logs of two machines do not line up",
                "timedatectl set-ntp true");
  return pass("UTC", found);
}

}  // namespace

std::vector<Check> real_time_checks(const KernelFacts& kernel, const LimitFacts& limits, const UtcFacts& utc,
                                    const RobotConfig* robot) {
  return {kernel_check(kernel),   priority_check(limits, highest_priority(robot)), memlock_check(limits),
          governor_check(kernel), isolation_check(kernel, pinned_cpus(robot)),     clock_check(kernel),
          utc_check(utc, robot)};
}

}  // namespace sprung::doctor
