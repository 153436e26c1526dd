#pragma once
/// Which processes a robot needs and with which arguments: pure, so that it can be tested without starting
/// any.
#include <cstdint>
#include <string>
#include <vector>

#include "robots/robot_config.h"

namespace sprung {

/// What sprung-recorder is told of its files; LCM's own lcm-logger knows none of it.
struct RecordingRequest {
  std::string channels = ".*";   ///< regular expression
  double split_MB = 0.0;         ///< 0 = never
  double split_min = 0.0;        ///< 0 = never
  double least_free_MB = 500.0;  ///< of the disk; 0 = never ends for it
  double keep_MB = 0.0;          ///< of the folder's logs, the oldest go first; 0 = all stay

  bool splits() const noexcept { return split_MB > 0.0 || split_min > 0.0; }
};

/// What `sprung up` was asked for.
struct LaunchRequest {
  std::string robot;               ///< name or folder
  std::string preset;              ///< empty = the robot's usual one
  std::string clock = "realtime";  ///< realtime or lockstep
  bool simulation = false;
  bool
      simulated_elsewhere = false;  ///< another program simulates the drives: only the longer watchdogs apply
  bool maintenance = false;         ///< robots/maintenance.h
  std::vector<std::string> can;     ///< BUS=ADDRESS
  std::string lcm_url;
  std::string rt_policy = "warn";
  std::uint64_t seed = 1;
  std::vector<std::string> plant;  ///< KEY=VALUE
  /// PROGRAM=SPEC, for tests of the links; SPEC of CAN bursts begins with can-.
  std::vector<std::string> inject;
  bool truth = true;
  double speed = 0.0;       ///< lock-step pace, 0 = as fast as it goes
  double timeout_s = 10.0;  ///< for each process to become ready, and for the drives to become operational
  std::int64_t cycles = 0;  ///< the bridge ends after that many, 0 = never
  std::string log_folder;   ///< empty = no recording
  std::string host;         ///< starts what robot.yaml gives to this host; empty = what it gives to none
  /// With the run's key; empty = a new one. All hosts of a run have the same.
  std::string key_file;
  std::string recorder = "sprung-recorder";  ///< or "lcm-logger"
  RecordingRequest recording;
  std::string command_line;  ///< what was typed, for the log's metadata
  std::string instance = "default";
};

struct PlannedProcess {
  std::string program;
  std::vector<std::string> arguments;
  RestartPolicy restart = RestartPolicy::kNever;
  bool gets_key = false;  ///< by --key-fd
};

inline constexpr const char* kBridgeProgram = "sprung-can-bridge";

/// @throws std::invalid_argument where the request contradicts itself or the robot, naming what to change.
void check_request(const LaunchRequest& request, const RobotConfig& robot);

/// In order of start, those of this host alone; the bridge, where it is one of them, comes last.
/// @throws as check_request.
std::vector<PlannedProcess> plan_processes(const LaunchRequest& request, const RobotConfig& robot,
                                           std::int64_t session, std::int64_t epoch_us);

/// A process that another host's `sprung up` starts.
struct RemoteProcess {
  std::string program;
  std::string host;  ///< empty = the host that has the bridge
};
std::vector<RemoteProcess> remote_processes(const LaunchRequest& request, const RobotConfig& robot);

/// Whether this launcher starts the bridge. It gives session and time to the launchers of other hosts.
bool leads(const LaunchRequest& request, const RobotConfig& robot);

}  // namespace sprung
