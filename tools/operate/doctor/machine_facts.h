#pragma once
/// What is known of a machine, as values: read by machine_reader_shell.h and the probes, judged by the
/// *_checks.h.
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "drivers/can/can_interface.h"

namespace sprung::doctor {

/// From /proc and /sys.
struct KernelFacts {
  std::int64_t receive_buffer_bytes = 0;         ///< net.core.rmem_max; 0 = not known
  std::map<std::string, std::string> governors;  ///< by CPU; empty where the frequency cannot be scaled
  std::vector<int> isolated_cpus;
  std::vector<int> cpus;                   ///< that are online; without hyper-threads e.g. 0, 2, 4, 6
  bool real_time = false;                  ///< PREEMPT_RT
  std::string clock_source;                ///< "tsc"; empty = not known
  std::vector<std::string> clock_sources;  ///< that there are
  /// Device by which 239.255.76.67 leaves, by the kernel's table of routes; empty = none.
  std::string multicast_device;
};

/// Of this process, which `sprung up` would hand on.
struct LimitFacts {
  std::int64_t rtprio = 0;         ///< highest SCHED_FIFO priority; -1 = unlimited
  std::int64_t memlock_bytes = 0;  ///< -1 = unlimited
  bool superuser = false;
  bool fifo_granted = false;  ///< a thread got SCHED_FIFO 1 just now
};

/// Messages that LCM sent to itself over multicast.
struct LoopbackFacts {
  std::string url;
  int sent = 0;
  int received = 0;
  std::string error;  ///< LCM did not start
};

struct SoftwareFacts {
  std::string lcm_version;
  bool has_lcm_gen = false;
  std::string own_version;  ///< "0.1.0 (abc)"
  std::int64_t types_hash = 0;
  std::map<std::string, std::string> programs;  ///< version by program; empty text = cannot be run
  /// Processes of the robot that is up and do not go together with this program, a sentence each.
  std::vector<std::string> strangers;
  bool robot_is_up = false;
};

struct DiskFacts {
  std::string folder;
  double free_MB = 0.0;
};

/// A bus of robot.yaml (or of --can) that is socketcan.
struct BusFacts {
  std::string name;
  std::string interface;
  std::optional<InterfaceFacts> facts;  ///< nothing: no such interface
};

}  // namespace sprung::doctor
