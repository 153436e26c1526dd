#pragma once
/// One joint of a robot in one process: booted, referenced and moved through the whole stack as an operator
/// would, and loaded from outside. What it hands out is what the stack measures. And a sweep on it, which
/// keeps what was measured at constant speed.
#include <functional>
#include <string>

#include "model/transmission.h"
#include "signals/joint_state.h"
#include "signals/operator.h"
#include "signals/simulation.h"
#include "signals/vec3.h"
#include "simulation/in_process/inprocess_robot.h"
#include "tools/lab/friction/friction_sweep_plan.h"

namespace sprung {

/// DRIVE_STATE of one cycle, in joint space.
struct BenchSample {
  double time_s = 0.0;
  double position_rad = kNaN;
  double motor_torque_Nm = kNaN;  ///< R Kt i with robot.yaml's constants
};

/// Range and speeds that a joint move may use.
struct BenchLimits {
  double position_min_rad = 0.0;
  double position_max_rad = 0.0;
  double speed_rad_s = 0.0;
  double acceleration_rad_s2 = 0.0;
  double rated_torque_Nm = 0.0;  ///< R Kt times the rated current: what the motor may give for long
};

/// By name; "" = the joint of the bench's torque sensor, else the first knee, else the first joint.
/// @throws std::invalid_argument naming the joints there are.
int bench_joint(const RobotConfig& robot, const std::string& joint_name);
BenchLimits bench_limits(const RobotConfig& robot, int joint);

class JointBench {
 public:
  using Observer = std::function<void(JointBench&)>;

  /// Boots. @throws std::runtime_error when the drives do not become operational.
  JointBench(const RobotConfig& robot, const std::string& preset, const SimOptions& sim, int joint);

  /// References whatever is not. @throws std::runtime_error with the reason.
  void home();
  /// As `sprung move`; the other joints are held. @param observe after every cycle; may be empty.
  /// @throws std::runtime_error when it is refused or fails.
  void move(double target_rad, double speed_rad_s, double acceleration_rad_s2, const Observer& observe = {});
  void run(double seconds, const Observer& observe = {});
  /// Lets the joints go: damped, then without power. @throws std::runtime_error when it is refused.
  void sit();

  /// A pure torque of the outside world on the joint's link, about the lateral axis, so for hips, knees and
  /// arms; positive accelerates the joint toward +q, once find_load_sense() was called. @param duration_s 0 =
  /// until the next.
  void load(double torque_Nm, double duration_s = 0.0);
  /// With the joint held: which sense of the axis that is, from the motor torque that it takes to hold
  /// against it.
  /// @param torque_Nm well above friction. @throws std::runtime_error for a joint that such a torque does not
  /// reach.
  void find_load_sense(double torque_Nm);

  BenchSample sample() const;
  const EstimatedJoint& estimate() const { return robot_.joint_state().joints[index_]; }
  const TrueJoint& truth() const { return robot_.truth().joints[index_]; }
  double time_s() const { return 1e-6 * static_cast<double>(robot_.drive_state().stamp.utime_us); }
  double cycle_s() const { return config_.cycle_s; }
  InProcessRobot& robot() { return robot_; }

 private:
  void tick(const Observer& observe);
  void ask(const OperatorCommand& command, double timeout_s, const Observer& observe);
  double mean_motor_torque_Nm(double seconds);

  const RobotConfig& config_;
  InProcessRobot robot_;
  std::size_t index_;
  int leg_ = 0;
  int in_leg_ = 0;  ///< index of the joint within its leg
  Transmission transmission_;
  double load_sense_ = 1.0;
};

struct RecordedPass {
  SweepPass pass;
  double velocity_rad_s = 0.0;  ///< measured, mean over the constant speed
  std::vector<double> time_s;
  std::vector<double> position_rad;
  std::vector<double> motor_torque_Nm;  ///< R Kt i, sample by sample as the drive sent it
  /// Newest reading of the bench's torque sensor; empty where there is none.
  std::vector<double> sensed_torque_Nm;
  double true_friction_Nm = 0.0;  ///< SIM_TRUTH, mean: to be drawn beside, nothing else
};

struct SweepRecording {
  SweepProtocol protocol = SweepProtocol::kS1;
  std::string robot;
  std::string joint;
  double gear_ratio = 0.0;
  std::uint64_t seed = 0;
  double simulated_s = 0.0;
  std::vector<RecordedPass> passes;
};

/// The pass's share of `plan.samples_a_pass` samples, out of those within its steady span.
/// @throws std::runtime_error where the robot refuses a move or the plant fails.
SweepRecording record_sweep(const RobotConfig& robot, const std::string& preset, const SimOptions& sim,
                            int joint, SweepProtocol protocol, const SweepPlan& plan);

}  // namespace sprung
