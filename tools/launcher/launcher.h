#pragma once
/// Starts a robot's processes, waits until each says on PROCESS_STATUS that it is ready, watches over them,
/// stops them in order. A process that dies is named and not started again: torque never comes back by
/// itself.
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "runtime/node.h"
#include "runtime/process_status.h"
#include "tools/launcher/child_process.h"
#include "tools/launcher/launch_plan.h"
#include "tools/launcher/run_file.h"

namespace sprung {

class Launcher {
 public:
  /// Takes the instance and writes its run file. @throws std::runtime_error when the instance runs already.
  Launcher(const LaunchRequest& request, const RobotConfig& robot);
  ~Launcher();  ///< stops whatever still runs and removes the run file
  Launcher(const Launcher&) = delete;
  Launcher& operator=(const Launcher&) = delete;

  /// Recorder and every process but the bridge; returns when each is ready. @throws std::runtime_error after
  /// a time-out or when one ended, naming it.
  void start_all_but_bridge();
  /// The bridge; returns when the drives are operational and the cycle runs.
  void start_bridge();

  /// Ends of processes since the last call, each with program and exit status.
  struct Ended {
    std::string program;
    int status = 0;
  };
  std::vector<Ended> newly_ended();
  /// Bridge first, so that the drives come to rest while their simulation still runs; recorder last.
  void stop();

  const RunInfo& info() const { return info_; }
  std::size_t running() const;

 private:
  struct Child {
    std::string program;
    std::unique_ptr<ChildProcess> process;
    bool reported = false;
  };
  void start(const PlannedProcess& planned);
  void start_recorder();
  void wait_for(const std::string& program, ProcessState state);
  ProcessState state_of(const std::string& program);
  void stop_one(Child& child, double patience_s);
  void refuse_the_dead();

  LaunchRequest request_;
  RobotConfig robot_;
  RunFile run_file_;
  RunInfo info_;
  std::vector<PlannedProcess> plan_;
  InputQueue<sprung_msgs::process_status_t> statuses_{256};
  Node node_;
  std::map<std::string, sprung_msgs::process_status_t> last_status_;
  std::vector<Child> children_;
};

/// A session id that no earlier run had.
std::int64_t random_session();
/// Whether an LCM url and a CAN address are free of other instances is the caller's matter; these give
/// hermetic ones.
std::string lcm_url_on_port(int port);

}  // namespace sprung
