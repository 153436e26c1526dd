#pragma once
/// All simulated nodes and the plant between them: shaft and link angles one way, motor torques the other.
#include <memory>
#include <optional>
#include <vector>

#include "robots/robot_config.h"
#include "simulation/node/sim_device.h"
#include "simulation/plant/plant.h"
#include "simulation/plant/power_supply.h"

namespace sprung::sim {

/// Between the actuators that drives know and the joints that the plant has: joint = T actuator for angles
/// and speeds, and by power balance joint torque = T^-T actuator torque. T is robot.yaml's.
class Transmission {
 public:
  /// @throws ConfigError on a leg whose matrix cannot be inverted, or an actuator or joint without a leg.
  explicit Transmission(const RobotConfig& robot);
  /// Angles or speeds; sizes as in the robot.
  void to_actuators(const std::vector<double>& joints, std::vector<double>& actuators) const noexcept;
  void torques_to_joints(const std::vector<double>& actuator_Nm,
                         std::vector<double>& joint_Nm) const noexcept;

 private:
  /// Of T^-1, where it is not zero: each leg has its own block.
  struct Share {
    std::size_t actuator = 0;
    std::size_t joint = 0;
    double of = 0.0;
  };
  std::vector<Share> shares_;  ///< by actuator, then joint
};

class DriveTrain {
 public:
  /// @throws ConfigError
  /// @param wiring by actuator; empty: every drive knows its motor.
  DriveTrain(const RobotConfig& robot, const SimConfig& config, std::uint64_t seed,
             const std::vector<DriveWiring>& wiring = {});

  /// Nodes' frames go here.
  void open(FrameBatch* out) noexcept;
  void receive(int bus, const CanFrame& frame, std::int64_t time_us) noexcept;
  /// Encoders and current sensors of a bus's nodes, read `late_s` after the plant's present state.
  void sample(int bus, double late_s, std::int64_t cycle) noexcept;
  /// One tick of every drive's loops.
  void step_drives(std::int64_t time_us) noexcept;
  /// One step of the plant under the drives' present torques.
  void step_plant() noexcept;
  void reset_plant() noexcept;

  bool all_operational() const noexcept;
  /// A fault of one drive, or of every node of a bus; targets that do not exist are ignored.
  void set_fault(int actuator, FaultKind kind, double value, bool on) noexcept;
  void set_bus_fault(int bus, FaultKind kind, double value, bool on) noexcept;
  /// @return nullptr where there is no such actuator.
  SimDrive* drive(int actuator) noexcept;
  /// What all drives have, of real windings with a supply of the robot.
  const std::optional<PowerSupply>& supply() const noexcept { return supply_; }
  Plant& plant() noexcept { return plant_; }
  const Plant& plant() const noexcept { return plant_; }

 private:
  /// Output angle of the rotor in the motor's own forward direction, extrapolated from the plant's state.
  double shaft_rad(std::size_t actuator, double late_s) const noexcept;
  /// Angle that an actuator's link encoder sees, before its direction and offset.
  double link_rad(std::size_t actuator, double late_s) const noexcept;
  void sample_links(int bus, double late_s, std::int64_t cycle) noexcept;
  void read_plant() noexcept;
  void step_supply() noexcept;

  std::vector<ActuatorConfig> actuators_;  ///< as they truly sit
  Plant plant_;
  Transmission transmission_;
  std::vector<SimDriveConfig> truths_;
  std::vector<SimCardConfig> card_truths_;
  std::vector<EncoderCardConfig> card_configs_;
  std::vector<std::unique_ptr<SimDrive>> drives_;
  std::vector<std::unique_ptr<SimCard>> cards_;
  std::optional<PowerSupply> supply_;
  double step_s_;
  std::uint64_t seed_;
  double jitter_s_;
  std::vector<double> joint_rad_, joint_rad_s_, joint_Nm_;
  std::vector<double> actuator_rad_, actuator_rad_s_, actuator_Nm_;  ///< motor side
  std::vector<double> link_rad_, link_rad_s_;                        ///< of the links, in actuator space
};

}  // namespace sprung::sim
