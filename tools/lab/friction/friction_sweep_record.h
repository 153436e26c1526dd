#pragma once
/// Drives a sweep's passes on the simulated robot and keeps what the stack measured at constant speed.
#include "tools/lab/friction/friction_sweep_bench.h"
#include "tools/lab/friction/friction_sweep_plan.h"

namespace sprung {

struct RecordedPass {
  SweepPass pass;
  double velocity_rad_s = 0.0;  ///< measured, mean over the constant speed
  std::vector<double> time_s;
  std::vector<double> position_rad;
  std::vector<double> motor_torque_Nm;  ///< R Kt i, sample by sample as the drive sent it
  std::vector<double>
      sensed_torque_Nm;           ///< newest reading of the bench's torque sensor; empty where there is none
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
