#pragma once
/// Listens to a running robot and hands over its cycles (cycle_assembler.h): for experiments on separate
/// processes. Nothing waits for it, so it keeps deep queues; a cycle of which a message was lost on the way
/// is counted, never made up.
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "robots/robot_config.h"
#include "runtime/node.h"
#include "signals/drive_command.h"
#include "signals/drive_state.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"
#include "signals/simulation.h"
#include "tools/operate/client/cycle_assembler.h"
#include "tools/operate/launcher/run_file.h"

namespace sprung {

class CycleCollector {
 public:
  /// Listens from here on. A cycle is whole with its SIM_TRUTH, so there must be simulated drives.
  CycleCollector(const RunInfo& info, const RobotConfig& robot);
  /// With the run's key (commanding() in run_file.h) it hears what the robot's own processes say, and nobody
  /// else.
  CycleCollector(const NodeOptions& options, const RobotConfig& robot);

  /// Hands over every cycle that is complete by now. @return how many.
  int collect(const CycleObserver& on_cycle, const ReplyObserver& on_reply);
  /// Sleeps until something comes in, at most that long.
  void wait(double seconds) {
    node_.wait_for_input(node_.utime_us() + static_cast<std::int64_t>(seconds * 1e6));
  }

  /// What the bridge misses after this cycle is no loss: it is about to end. Until then every cycle counts.
  void count_until(std::int64_t cycle) { counted_until_ = cycle; }
  std::int64_t last_cycle() const { return assembler_.last_cycle(); }  ///< handed over or given up
  std::int64_t lost_cycles() const { return assembler_.lost_cycles(); }
  std::int64_t overruns() const { return overruns_; }            ///< as the bridge counts them
  std::int64_t missed_cycles() const { return missed_cycles_; }  ///< without a DRIVE_COMMAND
  /// What a process says of a run that is not deterministic before that cycle; empty while none does.
  const std::string& not_deterministic() const { return not_deterministic_; }
  std::int64_t repeats() const { return repeats_; }  ///< lock-step: what the bridge had to ask for again

 private:
  template <class Signal>
  void take(InputQueue<Signal>& queue) {
    while (auto signal = queue.pop()) assembler_.add(std::move(*signal));
  }
  void take_motions();
  void take_status(const sprung_msgs::process_status_t& status);
  void take_all(const ReplyObserver& on_reply);

  RobotConfig robot_;
  InputQueue<DriveState> drive_states_;
  InputQueue<JointState> joint_states_;
  InputQueue<DriveCommand> drive_commands_;
  InputQueue<SimTruth> truths_;
  InputQueue<LegCommand> leg_commands_;
  InputQueue<sprung_msgs::motion_state_t> motions_;
  InputQueue<sprung_msgs::operator_reply_t> replies_;
  InputQueue<sprung_msgs::safety_state_t> safeties_;
  InputQueue<sprung_msgs::process_status_t> statuses_;
  CycleAssembler assembler_;
  std::int64_t counted_until_ = std::numeric_limits<std::int64_t>::max();
  std::int64_t overruns_ = 0;
  std::int64_t missed_cycles_ = 0;
  std::int64_t repeats_ = 0;
  std::string not_deterministic_;
  Node node_;
};

}  // namespace sprung
