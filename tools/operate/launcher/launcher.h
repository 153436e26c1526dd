#pragma once
/// Starts a robot's processes, waits until each says on PROCESS_STATUS that it is ready, watches over them,
/// stops them in order. A process that dies is named; it is started again only where restart_rule.h lets it:
/// torque never comes back by itself.
#include <cstdint>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "runtime/message_key.h"
#include "runtime/node.h"
#include "runtime/process_status.h"
#include "runtime/resource_use.h"
#include "tools/operate/launcher/build_match.h"
#include "tools/operate/launcher/child_process.h"
#include "tools/operate/launcher/launch_plan.h"
#include "tools/operate/launcher/log_lines.h"
#include "tools/operate/launcher/restart_rule.h"
#include "tools/operate/launcher/run_description.h"
#include "tools/operate/launcher/run_file.h"
#include "tools/operate/launcher/status_board.h"
#include "tools/operate/launcher/torque_watch.h"

namespace sprung {

class Launcher {
 public:
  /// Takes the instance and writes its run file; with a host that has no bridge, waits for the launcher that
  /// has it.
  /// @throws std::runtime_error when the instance runs already, another run is in the way, or nobody leads;
  /// as check_request.
  Launcher(const LaunchRequest& request, const RobotConfig& robot);
  ~Launcher();  ///< stops whatever still runs and removes the run file
  Launcher(const Launcher&) = delete;
  Launcher& operator=(const Launcher&) = delete;

  /// Where the lines of the processes go, instead of to standard error. Before starting anything.
  void on_line(std::function<void(const LogLine&)> sink) { sink_ = std::move(sink); }

  /// Called in every look(), also while start...() waits.
  void on_turn(std::function<void()> turn) { turn_ = std::move(turn); }

  /// Recorder and every process but the bridge, also those of other hosts; returns when each is ready.
  /// @throws std::runtime_error after a time-out, when one ended, or when one is of another build or
  /// configuration; naming it.
  void start_all_but_bridge();
  /// The bridge, or waits for that of another host; returns when the drives are operational and the cycle
  /// runs.
  void start_bridge();

  /// Ends of processes since the last call.
  struct Ended {
    std::string program;
    int status = 0;           ///< 0..255, or 128 + signal
    bool comes_back = false;  ///< restart_rule.h will start it again
  };
  std::vector<Ended> newly_ended();
  /// Reads what came, starts again what may, says on PROCESS_STATUS that it lives. Call it many times a
  /// second.
  void look();
  /// What went wrong since the last call without a process having ended: one that is silent, does not belong
  /// here, runs twice, or cannot be started again.
  std::vector<std::string> new_trouble();
  /// The launcher that leads has ended or is silent; false on the lead itself.
  bool lead_is_gone() const;
  /// Bridge first, so that the drives come to rest while their simulation still runs; recorder last.
  void stop();
  /// Whether every process that stop() asked ended by itself; each that did not was named.
  bool stopped_in_order() const { return stopped_in_order_; }

  const RunInfo& info() const { return info_; }
  std::size_t running() const;
  bool all_run() const { return running() == children_.size(); }
  std::vector<ProcessRow> rows() const;
  const std::optional<sprung_msgs::safety_state_t>& safety() const { return safety_; }
  void say(const std::string& text);  ///< a line of the launcher's own

 private:
  struct Child {
    PlannedProcess planned;
    std::unique_ptr<ChildProcess> process;
    LineSplitter lines;
    EndedProcess end;  ///< policy and count; the time once it has ended
    bool reported = false;
  };
  void start(const PlannedProcess& planned);
  void start_recorder();
  std::unique_ptr<ChildProcess> run_program(const PlannedProcess& planned) const;
  void start_again(Child& child);
  void start_anew(Child& child);
  void start_new_log(Child& recorder);
  void start_again_what_may();
  void wait_for(const std::string& program, ProcessState state);
  std::string not_ready_text(const std::string& program, ProcessState state) const;
  void refuse_trouble();
  void read_statuses();
  void refuse_stranger(const sprung_msgs::process_status_t& status, Child* child);
  void name_twice(const sprung_msgs::process_status_t& status);
  void name_misfit(const sprung_msgs::process_status_t& status);
  Child* child_named(const std::string& program);
  void name_the_silent();
  void read_lines(Child& child);
  void tell(const LogLine& line);
  void publish_status();
  void stop_one(Child& child, double timeout_s);
  void wait_while_it_speaks(Child& child);

  LaunchRequest request_;
  RobotConfig robot_;
  const std::string host_name_ = host_name();
  bool leads_;
  std::shared_ptr<const MessageKey> key_;
  RunFile run_file_;
  RunInfo info_;
  std::vector<PlannedProcess> plan_;
  std::vector<RemoteProcess> remote_;
  BuildIdentity identity_;
  bool mixed_builds_;
  InputQueue<sprung_msgs::process_status_t> statuses_{256};
  InputQueue<sprung_msgs::safety_state_t> safeties_{256};
  Node node_;
  Publisher<ProcessStatus> publisher_;
  StatusSchedule schedule_;
  ProcessState state_ = ProcessState::kStarting;
  StatusBoard board_;
  std::int64_t looked_us_ = 0;
  bool stopped_in_order_ = true;
  std::optional<sprung_msgs::safety_state_t> safety_;
  std::unique_ptr<TorqueWatch> torque_watch_;  ///< while a process waits to be started again
  std::vector<std::string> trouble_;
  std::set<std::string> named_;  ///< of which trouble was told
  std::vector<Child> children_;
  std::function<void(const LogLine&)> sink_;
  std::function<void()> turn_;
  std::ofstream line_file_;  ///< beside the log
};

}  // namespace sprung
