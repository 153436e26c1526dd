#pragma once
/// The frame of every process: options, robot file, real-time set-up, node, signals, status, exit code.
/// A program is
///
///   int main(int argc, char** argv) {
///     return sprung::run_process(argc, argv, {"sprung-x", "What it does."}, [](sprung::Process& process) {
///       ...;
///       return 0;
///     });
///   }
#include <functional>
#include <memory>
#include <string>

#include "robots/robot_config.h"
#include "runtime/loop_statistics.h"
#include "runtime/node.h"
#include "runtime/process_options.h"
#include "runtime/process_status.h"
#include "runtime/resource_use.h"
#include "signals/modes.h"

namespace sprung {

struct ProgramInfo {
  std::string program;      ///< "sprung-torque-estimator"
  std::string description;  ///< for --help
  bool only_looks = false;  ///< needs no key: it neither moves the robot nor obeys
};

/// What a running process has at hand. Owned by run_process().
class Process {
 public:
  Process(const ProgramInfo& info, const ProcessOptions& options, const RobotConfig& robot,
          const std::string& real_time);

  const ProcessOptions& options() const noexcept { return options_; }
  const RobotConfig& robot() const noexcept { return robot_; }
  const PresetConfig& preset() const { return robot_.preset(options_.preset); }
  const WatchdogConfig& watchdogs() const noexcept { return watchdogs_for(robot_, options_); }
  bool lockstep() const noexcept { return options_.clock_mode() == ClockMode::kLockstep; }
  Node& node() noexcept { return node_; }
  LoopStatistics& statistics() noexcept { return statistics_; }
  /// Fields that only the process knows: stamp.seq, sequence_gaps, input_age_us, detail.
  ProcessStatus& status() noexcept { return status_; }

  void set_state(ProcessState state);  ///< and publishes it
  /// What `status` shall say from now on, whatever else the detail says. The first one is published at once.
  void set_standing_note(const std::string& note);
  void publish_status_if_due();  ///< call in every turn of the loop; at most twice a second, and on change

 private:
  void publish_status();
  const ProcessOptions options_;
  const RobotConfig robot_;
  Node node_;
  LoopStatistics statistics_;
  CpuMeter cpu_meter_;
  ProcessStatus status_;
  std::string standing_note_;
  Publisher<ProcessStatus> publisher_;
  StatusSchedule schedule_;
};

/// Runs `body` with everything set up, kReady published by the body's set_state and kStopping afterwards.
/// @param more_options adds options of this program alone.
/// @return exit status: what body returned, 1 on an exception (logged), 2 on wrong use.
int run_process(int argc, char** argv, const ProgramInfo& info, const std::function<int(Process&)>& body,
                const std::function<void(CommandLine&)>& more_options = {});

}  // namespace sprung
