#pragma once
/// The simulated robot without its process: full CANopen drives in front of a MuJoCo plant. Frames and a time
/// in, frames and the truth out. The same core serves lock-step and in-process runs (frames given with the
/// times at which they act) and real time (frames given as they arrive).
///
/// The plant is held still until the first SYNC that finds every drive NMT-operational: that SYNC is cycle 0.
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "drivers/can/can_frame.h"
#include "robots/robot_config.h"
#include "signals/sensors.h"
#include "signals/simulation.h"
#include "simulation/node/motor_wiring.h"

namespace sprung {

struct SimOptions {
  std::uint64_t seed = 1;
  /// Changes values of sim.yaml for this run: friction_scale, mass_scale, kt_scale, ground_stiffness, ...
  /// (docs in sim.yaml).
  std::map<std::string, double> plant;
  bool truth = true;  ///< fill SIM_TRUTH; must change nothing else
  /// By actuator: drives that are still to be commissioned. Empty: they know their motors.
  std::vector<sim::DriveWiring> wiring{};
  bool runs_from_power_on = false;  ///< the plant does not wait for cycle 0: nobody boots the drives
};

class SimCore {
 public:
  /// Reads sim.yaml and model.xml from robot.folder. @throws ConfigError (see robots/robot_loader.h).
  SimCore(const RobotConfig& robot, const SimOptions& options);
  ~SimCore();
  SimCore(const SimCore&) = delete;
  SimCore& operator=(const SimCore&) = delete;

  /// A frame from the master that acts at time_us (>= the last advance_to); kept until then.
  void receive(int bus, const CanFrame& frame, std::int64_t time_us) noexcept;
  /// Steps drives and plant up to and including time_us; what the drives sent is appended to out. Time never
  /// goes back: an earlier time_us, or a frame that came too late, acts at the present.
  void advance_to(std::int64_t time_us, FrameBatch& out) noexcept;
  /// When the master's i-th frame of a burst acts: SYNC at the tick, answers and set-points after it by the
  /// bus schedule (55 + 10 n us a frame at 1 Mbit/s) and the configured compute time. Used by lock-step and
  /// in-process shells.
  void receive_burst(const FrameBatch& burst, std::int64_t last_sync_us, std::int64_t sync_us) noexcept;

  void control(const SimControl& control) noexcept;
  std::int64_t cycle() const noexcept;     ///< of the last SYNC; -1 before cycle 0
  const SimTruth& truth() const noexcept;  ///< at the last SYNC
  /// Readings of sim.yaml's torque sensor since cycle 0: how many, one of the newest sixteen, and the newest,
  /// whose joint is -1 before the first and where there is no sensor.
  std::int64_t torque_reading_count() const noexcept;
  const TorqueSensor& torque_reading(std::int64_t n) const noexcept;
  const TorqueSensor& torque_sensor() const noexcept;
  /// sim.yaml's IMU, sampled at a SYNC from cycle 0 on: of this cycle when its stamp's seq is cycle(). Older,
  /// -1 at first, while it is silent or where there is none.
  const Imu& imu() const noexcept;
  /// Of one actuator's motor at its gear's output, now: not what the bus says. For experiments.
  double true_motor_torque_Nm(int actuator) noexcept;
  /// At its motor's terminals, R i + Ke w, now; 0 where sim.yaml has no winding. For experiments.
  double true_winding_V(int actuator) noexcept;
  /// What all drives have; NaN unless windings are real and sim.yaml has a supply. For experiments.
  double true_supply_V() const noexcept;
  /// Of a joint, now, as it truly is. For experiments. @param joint of the robot.
  double true_position_rad(int joint) const noexcept;
  /// Torque that holds it where it is, at rest and without friction.
  double true_load_Nm(int joint) const noexcept;
  /// Somebody pushes a joint from outside, Nm about its positive direction, until told otherwise. For
  /// experiments.
  void push_joint(int joint, double torque_Nm) noexcept;
  bool failed() const noexcept;  ///< a MuJoCo warning or a number that is not finite: the run is void
  const char* failure() const noexcept;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace sprung
