#pragma once
/// What the simulated drives' process does around the core in each clock.
#include <string>
#include <vector>

#include "runtime/process.h"
#include "signals/sensors.h"
#include "signals/simulation.h"
#include "simulation/repeated_controls.h"
#include "simulation/sim_core.h"

namespace sprung {

struct SimProgramOptions {
  std::vector<std::string> can;         ///< BUS=ADDRESS, instead of robot.yaml's
  std::vector<std::string> inject_can;  ///< lock-step: faults of the CAN link, see parse_burst_faults
  std::vector<std::string> plant;       ///< KEY=VALUE
  SimOptions sim;
};

/// SIM_TRUTH, IMU and TORQUE_SENSOR out, SIM_CONTROL in; refuses to go on when the plant has failed.
class SimShell {
 public:
  SimShell(Process& process, SimCore& core, bool truth);
  void take_controls();
  /// SIM_TRUTH and IMU once a cycle, TORQUE_SENSOR at the sensor's rate. @throws std::runtime_error when the
  /// plant failed.
  void publish();
  /// IMU of the present cycle, once. Lock-step: before the answers to its SYNC, and of a robot with an IMU
  /// also when there is nothing measured (kStarting), since the estimator waits for it.
  void publish_imu(std::int64_t sync_us);
  /// IMU of the present cycle once more, for whoever has not got it.
  void repeat();

 private:
  void publish_torque_readings();

  Process& process_;
  SimCore& core_;
  const bool truth_;
  InputQueue<SimControl> controls_;
  sim::RepeatedControls repeated_;
  Publisher<SimTruth> truths_;
  Publisher<Imu> imus_;
  const bool imu_is_awaited_;
  Imu imu_;  ///< as published last
  Publisher<TorqueSensor> torque_readings_;
  std::int64_t torque_readings_published_ = 0;
  std::int64_t published_cycle_ = -1;
};

/// The bridge's SYNC is the tick. When it stays away for a second of wall time, time goes on by the wall
/// clock, so that the drives' own watchdogs see that their master is gone.
int run_sim_lockstep(Process& process, const SimProgramOptions& options);
/// Own absolute timer; SYNC only samples.
int run_sim_realtime(Process& process, const SimProgramOptions& options);

}  // namespace sprung
