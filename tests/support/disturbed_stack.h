#pragma once
/// The whole stack in this process, as InProcessRobot, but processes may stall: what they say is then
/// missing. Notes who acted.
#include <array>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "controller/controller_core.h"
#include "drivers/bridge/bridge_core.h"
#include "estimator/estimator_core.h"
#include "planner/planner_core.h"
#include "signals/drive_command.h"
#include "signals/drive_state.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"
#include "signals/motion_state.h"
#include "signals/operator.h"
#include "simulation/sim_core.h"

namespace sprung::test {

class DisturbedStack {
 public:
  /// What does not come in the coming cycles.
  struct Missing {
    bool drive_state = false;  ///< to the estimator, and so to all behind it
    bool leg_command = false;
    bool drive_command = false;
    bool heartbeat = false;  ///< of the bridge
  };

  /// Preset best.
  DisturbedStack(const RobotConfig& robot, const std::map<std::string, double>& plant);

  /// From the floor, or hanging: home and stand. @throws std::runtime_error where it does not stand.
  void stand_up();
  void run(double seconds);
  void run_cycles(int cycles);
  void ask(OperatorCommand command);
  void overrun() { bridge_.count_overrun(time_us_); }
  void fault(FaultKind kind, int actuator, double value, double duration_s);
  void floor(double height_m, int leg);
  void push(const std::array<double, 6>& wrench, double duration_s);

  Missing missing;
  /// Since watch(): each limit that has acted by a word or two; of clamps also those that a drive does by
  /// itself.
  const std::set<std::string>& acted() const { return acted_; }
  void watch();

 private:
  void tick();
  void exchange_frames();
  void run_cores();
  void note();
  void note_clamps();
  void note_drives();

  RobotConfig robot_;
  std::int64_t cycle_us_;
  std::int64_t time_us_ = 0;
  BridgeCore bridge_;
  SimCore sim_;
  EstimatorCore estimator_;
  PlannerCore planner_;
  ControllerCore controller_;
  DriveState drive_state_;
  JointState joint_state_;
  LegCommand leg_command_;
  MotionState motion_state_;
  DriveCommand drive_command_;
  FrameBatch to_drives_, from_drives_;
  LimitCounts before_;
  std::set<std::string> acted_;
  std::vector<int> weak_cycles_;  ///< of each actuator: its drive has given less than it was told for so long
  std::int64_t said_ = 0;
  bool watching_ = false;
};

}  // namespace sprung::test
