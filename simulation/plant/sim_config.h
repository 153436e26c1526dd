#pragma once
/// robots/<name>/sim.yaml: the true plant and the simulated drives, as read by SimCore alone. Start-up only.
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "robots/robot_config.h"
#include "robots/yaml_reader.h"
#include "simulation/plant/drive_truth.h"
#include "simulation/plant/ground.h"
#include "simulation/plant/imu_sensor.h"
#include "simulation/plant/joint_config.h"
#include "simulation/plant/torque_sensor.h"

namespace sprung::sim {

/// A body's inertia in model.xml is scaled along with its mass.
struct PlantBodyConfig {
  std::string name;
  double mass_kg = 0.0;
  Vec3 shift_m{};              ///< of the centre of mass from where model.xml has it, the body's axes
  double length_factor = 1.0;  ///< on the places of the bodies that it carries, and of its spheres: its foot
};

struct ContactConfig {
  double stiffness_N_m = 0.0;
  double damping_N_s_m = 0.0;
  double friction = 0.0;  ///< Coulomb coefficient, foot on floor
};

/// A point mass fixed to the trunk, as what somebody straps on its back.
struct PayloadConfig {
  double mass_kg = 0.0;
  Vec3 place_m{0.0, 0.0, 0.15};  ///< trunk axes
};

struct PlantConfig {
  double step_s = 0.0;
  double suspended_m = 0.0;     ///< the base hangs fixed at this height; 0 = it is free
  bool lies = false;            ///< it starts on the floor, joints at `lying`; else at `initial`
  double foot_weight_kg = 0.0;  ///< clamped to every foot's centre
  PayloadConfig payload;
  double foot_radius_factor = 1.0;  ///< on the radius that model.xml gives the feet
  double roll_rad = 0.0;  ///< of a free trunk at the start, against the floor below it: it may lie on its
                          ///< side or back
  bool rail_x_locked = false;  ///< only where model.xml has a joint `rail_x`
  double floor_height_m = 0.0;
  GroundConfig ground;
  double ambient_degC = 24.0;  ///< of the gears at the start too
  bool torsion = true;         ///< false: joints with torsion are rigid in this run
  std::vector<PlantBodyConfig> bodies;
  std::vector<PlantJointConfig> joints;  ///< in the order of RobotConfig::joints
  ContactConfig contact;
};

/// Of a strain wave gear: what its link encoder sees besides the joint's angle, amplitude sin(order motor
/// angle + phase) (facts papers D7). Seen by the encoder alone: it does not twist a gear that has torsion, so
/// it excites nothing.
struct KinematicErrorConfig {
  double amplitude_rad = 0.0;  ///< of the output
  double order = 2.0;          ///< per motor turn; the wave generator has two lobes
  double phase_rad = 0.0;
};

/// How motor and link encoder truly sit. What is not given sits as robot.yaml believes.
struct MountingConfig {
  std::optional<double> direction;  ///< +1 or -1, as ActuatorConfig::direction
  std::optional<double> link_direction;
  std::optional<double> link_offset_rad;  ///< there where link_direction is
  double zero_error_rad = 0.0;  ///< by which motor and link encoder show more than the joint's angle
};

/// True values of one drive and motor; what the stack believes is in robot.yaml.
struct SimDriveConfig {
  std::string actuator;
  double torque_constant_Nm_A = 0.0;  ///< motor side
  double torque_loop_Hz = 0.0;        ///< first-order bandwidth of the current loop
  double peak_torque_Nm = 0.0;        ///< gear output side, what the power stage can give
  double torque_noise_Nm = 0.0;       ///< rms of the torque shown in 0x6077, gear output side
  double supply_V = 0.0;
  double quick_stop_damping_Nm_s_rad = 0.0;
  // Optional keys of sim.yaml.
  double supply_min_V = 10.0;    ///< below: under-voltage; range of an EPOS2 50/5's supply [unverified]
  double supply_max_V = 56.0;    ///< above: over-voltage [unverified]
  bool absolute_encoder = true;  ///< false: count 0 is where the shaft was at power-on
  double index_angle_rad = 0.0;  ///< of the motor's shaft, where the encoder's index pulse is
  double smoothing_s = 0.0;      ///< over which a new position set-point is drawn in; 0 = the make's own way
  double mode_delay_s = 0.0;     ///< from a new 0x6060 to its confirmation in 0x6061 [unverified]
  int factory_node = 0;  ///< node id it was delivered with, 255 = none: LSS gives it one (a make that has it)
  bool starts_in_fault = false;  ///< 0x8120 at power-on, as when nobody acknowledges (facts canopen 2.5)
  std::optional<bool> latches_communication_faults;  ///< instead of the make's own way
  KinematicErrorConfig kinematic_error;
  MountingConfig mounting;
  std::optional<WindingConfig> winding;
  CurrentSensorConfig current_sensor;
  PositionLoopConfig position_loop;
};

/// An encoder card.
struct SimCardConfig {
  std::string name;
  double noise_rad = 0.0;  ///< rms of a link encoder's reading
};

struct SimConfig {
  PlantConfig plant;
  std::vector<SimDriveConfig> drives;  ///< in the order of RobotConfig::actuators
  std::vector<SimCardConfig> cards;    ///< in the order of RobotConfig::encoder_cards
  std::optional<TorqueSensorConfig> torque_sensor;
  std::optional<ImuConfig> imu;  ///< only where model.xml hangs the base on a free joint
  TimingConfig timing;
  bool real_windings = false;  ///< false: drives reach every current up to their peak, whatever the voltage
  std::optional<SupplyConfig> supply;  ///< of real windings; nothing: each drive's own voltage, stiff
};

/// Reads sim.yaml in robot.folder, then applies the `--plant` changes: draw and family first (plant_draw.h).
/// @throws ConfigError with file, line and reason.
SimConfig load_sim_config(const RobotConfig& robot, const std::map<std::string, double>& changes);

/// The same of a sim.yaml that is read already, without changes.
SimConfig read_sim_config(const YamlMap& file, const RobotConfig& robot);

/// `--plant key=value`. @throws ConfigError on an unknown key, naming those there are, or a value out of
/// range.
void apply_plant_changes(const std::map<std::string, double>& changes, SimConfig& config);

}  // namespace sprung::sim
