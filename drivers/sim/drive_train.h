#pragma once
/// All simulated drives and the plant between them: shaft angles one way, motor torques the other.
#include <memory>
#include <vector>

#include "drivers/sim/plant.h"
#include "drivers/sim/sim_device.h"
#include "drivers/sim/transmission.h"

namespace sprung::sim {

class DriveTrain {
 public:
  /// @throws ConfigError
  DriveTrain(const RobotConfig& robot, const SimConfig& config, std::uint64_t seed);

  /// Drives' frames go here.
  void open(FrameBatch* out) noexcept;
  void receive(int bus, const CanFrame& frame, std::int64_t time_us) noexcept;
  /// Encoders and current sensors of a bus's drives, read `late_s` after the plant's present state.
  void sample(int bus, double late_s, std::int64_t cycle) noexcept;
  /// One tick of every drive's loops.
  void step_drives(std::int64_t time_us) noexcept;
  /// One step of the plant under the drives' present torques.
  void step_plant() noexcept;
  void reset_plant() noexcept;

  bool all_operational() const noexcept;
  /// @return nullptr where there is no such actuator.
  SimDrive* drive(int actuator) noexcept;
  Plant& plant() noexcept { return plant_; }
  const Plant& plant() const noexcept { return plant_; }

 private:
  /// Output angle in the motor's own forward direction, extrapolated from the plant's state.
  double shaft_rad(std::size_t actuator, double late_s) const noexcept;
  void read_plant() noexcept;

  std::vector<ActuatorConfig> actuators_;
  Plant plant_;
  Transmission transmission_;
  std::vector<std::unique_ptr<SimDrive>> drives_;
  std::uint64_t seed_;
  double jitter_s_;
  std::vector<double> joint_rad_, joint_rad_s_, joint_Nm_;
  std::vector<double> actuator_rad_, actuator_rad_s_, actuator_Nm_;
};

}  // namespace sprung::sim
