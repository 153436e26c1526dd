#pragma once
/// The whole robot in one process: the same cores as the separate processes, called in the same order on the
/// same frames, so that a run here and a lock-step run of separate processes agree bit for bit (design
/// section 4). For experiments, sweeps and tests.
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "controller/controller_core.h"
#include "drivers/bridge/bridge_core.h"
#include "estimator/estimator_core.h"
#include "planner/planner_core.h"
#include "robots/robot_config.h"
#include "signals/drive_command.h"
#include "signals/drive_state.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"
#include "signals/motion_state.h"
#include "signals/operator.h"
#include "signals/sensors.h"
#include "signals/simulation.h"
#include "simulation/in_process/in_process_links.h"
#include "simulation/sim_core.h"

namespace sprung {

/// LEG_COMMAND(k) from JOINT_STATE(k).
using LegCommandSource = std::function<void(const JointState&, LegCommand&)>;

/// Changes DRIVE_COMMAND(k).
using DriveCommandChange = std::function<void(DriveCommand&)>;

/// Programs whose cores are in here.
enum class StackProcess { kBridge, kEstimator, kPlanner, kController };

class InProcessRobot;

/// Sees what goes into a robot in this process and what comes out, e.g. to write it to a log.
class InProcessObserver {
 public:
  virtual ~InProcessObserver() = default;
  virtual void on_command(
      const OperatorCommand& command) = 0;                 ///< before the cycle in which it can take effect
  virtual void on_cycle(const InProcessRobot& robot) = 0;  ///< after each
  virtual void on_reply(const OperatorReply& reply) = 0;   ///< when the robot's user takes it
};

class InProcessRobot {
 public:
  /// Gives an observer to a robot that is being made; nullptr: none. Called in the thread that makes it.
  using ObserverSource = std::function<std::unique_ptr<InProcessObserver>(
      const RobotConfig& robot, const std::string& preset, const SimOptions& sim)>;
  /// For every robot made from now on. Call it before there are threads.
  static void observe_all_by(ObserverSource source);

  /// @throws ConfigError, std::invalid_argument as the cores do.
  InProcessRobot(const RobotConfig& robot, const std::string& preset, const SimOptions& sim);
  /// The stack believes what is not true of the machine: `robot` is its file, `machine` the one that the
  /// simulated drives are made of. For wrong files that got past every check. @throws as above.
  InProcessRobot(const RobotConfig& robot, const std::string& preset, const RobotConfig& machine,
                 const SimOptions& sim);

  /// One SYNC and all that follows from it. @return true when it was a cycle, false while the drives boot.
  bool tick();
  /// Ticks until cycle 0 has run. @throws std::runtime_error with the bridge's boot detail after `limit_s` of
  /// message time.
  void boot(double limit_s = 5.0);

  /// From now on these commands instead of the planner's, which is stepped no more: for experiments with
  /// motions that no planner makes. @param source does not throw.
  void command_legs_by(LegCommandSource source) { leg_source_ = std::move(source); }
  /// From now on every DRIVE_COMMAND goes through this on its way to the bridge: what a broken controller, or
  /// somebody in its name, would send. @param change does not throw.
  void forge_commands_by(DriveCommandChange change) { forger_ = std::move(change); }

  /// From now on every message and frame goes by these; nullptr: as they are. They must outlive the robot.
  void put_on_links(InProcessLinks* links) { links_ = links; }

  /// From now on this program does nothing, as one that was killed or stopped (SIGSTOP): what it said last is
  /// all that the others have of it. false: it goes on where it was.
  void stop(StackProcess which, bool stopped = true) { stopped_[static_cast<std::size_t>(which)] = stopped; }

  /// To planner or bridge, by kind. Takes effect at command.apply_at_seq or in the next cycle.
  void submit(const OperatorCommand& command);
  /// Replies in order; false when there is none left.
  bool next_reply(OperatorReply& out);

  std::int64_t cycle() const { return drive_state_.stamp.seq; }
  const DriveState& drive_state() const { return drive_state_; }
  const JointState& joint_state() const { return joint_state_; }
  /// @return false: a robot without a trunk.
  bool body_state(BodyState& out) const { return estimator_.body_state(out); }
  const LegCommand& leg_command() const { return leg_command_; }
  const MotionState& motion_state() const { return motion_state_; }
  const DriveCommand& drive_command() const { return drive_command_; }
  const Imu& imu() const { return sim_.imu(); }  ///< seq -1: none
  /// Whether the planner makes the leg commands.
  bool planned() const { return !leg_source_; }
  const SimTruth& truth() const { return sim_.truth(); }
  const BridgeCore& bridge() const { return bridge_; }
  SimCore& sim() { return sim_; }

 private:
  bool advance_without_bridge();
  void exchange_frames();
  void give_to_drives();
  void run_cores();
  template <class Signal>
  const Signal* heard(const Signal& said, Signal& copy);
  const LegCommand* heard_legs();
  void plan(const JointState& estimated);
  bool take_reply(OperatorReply& out);
  bool runs(StackProcess which) const { return !stopped_[static_cast<std::size_t>(which)]; }

  const std::int64_t cycle_us_;
  std::int64_t time_us_ = 0;
  BridgeCore bridge_;
  SimCore sim_;
  EstimatorCore estimator_;
  PlannerCore planner_;
  ControllerCore controller_;
  LegCommandSource leg_source_;    ///< nothing: the planner
  std::array<bool, 4> stopped_{};  ///< by StackProcess
  DriveCommandChange forger_;      ///< nothing: the controller's commands as they are
  InProcessLinks* links_ = nullptr;
  FrameBatch foreign_;
  DriveState drive_state_;
  JointState joint_state_;
  LegCommand leg_command_;  ///< of the last cycle when the controller reads it
  MotionState motion_state_;
  DriveCommand drive_command_;
  DriveState heard_drive_state_;  ///< these five: behind the links
  JointState heard_joint_state_;
  LegCommand passing_leg_command_, heard_leg_command_;
  Imu heard_imu_;
  FrameBatch to_drives_;
  FrameBatch from_drives_;
  OperatorReply bridge_reply_;
  bool has_bridge_reply_ = false;
  std::unique_ptr<InProcessObserver> observer_;  ///< nullptr: none
};

}  // namespace sprung
