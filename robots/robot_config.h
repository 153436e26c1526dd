#pragma once
/// All that the stack knows about a robot: robots/<name>/robot.yaml, read once and validated
/// (robots/robot_loader.h). The plant's own values live in sim.yaml and model.xml and are read by
/// sprung-sim-drives alone.
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "model/leg_config.h"
#include "robots/adaptive_landing_config.h"
#include "robots/commissioning_config.h"
#include "robots/estimation_config.h"
#include "robots/gait_config.h"
#include "robots/identification_config.h"
#include "robots/torsion_config.h"

namespace sprung {

/// One CAN bus. `can` is a bus address: socketcan:can0, udp:239.74.163.2:43113 or memory:.
struct BusConfig {
  std::string name;
  std::string can;
};

/// Expected 0x1018 identity; 0 = not checked.
struct IdentityConfig {
  std::uint32_t vendor = 0;
  std::uint32_t product = 0;
  std::uint32_t revision = 0;
  std::uint32_t serial = 0;
};

/// How the bridge and a node watch each other.
enum class NodeWatch : std::int8_t {
  kHeartbeat,  ///< each sends its own (0x1017, 0x1016)
  kGuarding,   ///< the bridge asks by remote frames, and the node watches that it does (0x100C, 0x100D): for
               ///< nodes without heartbeat
};

/// A node that reads encoders on the link side of gears: three 20-bit encoders and a counter in 64 bits.
struct EncoderCardConfig {
  std::string name;
  int bus = 0;          ///< index into RobotConfig::buses
  int node = 0;         ///< CANopen node id, 1..126
  std::string profile;  ///< drivers/profiles/<profile>
  IdentityConfig identity;
  NodeWatch watch = NodeWatch::kHeartbeat;
};

/// Encoder on the link side of an actuator's gear, absolute over its turn.
struct LinkEncoderConfig {
  int card = -1;    ///< index into RobotConfig::encoder_cards; -1 = there is none
  int channel = 0;  ///< on the card, from 0
  double counts_per_turn = 0.0;
  double direction = 1.0;   ///< +1 or -1, its own: not the motor's
  double offset_rad = 0.0;  ///< position at count zero
};

/// How `sprung home` finds the actuator's zero.
enum class ReferenceMethod : std::int8_t {
  kNone,   ///< `referenced` and `offset` of robot.yaml hold
  kLink,   ///< from the link encoder
  kIndex,  ///< from the motor encoder's index pulse; the right turn by the jig's position
  kJig,    ///< the robot stands in its jig: the position is known
};

struct ReferenceConfig {
  ReferenceMethod method = ReferenceMethod::kNone;
  bool absolute_encoder = true;     ///< motor encoder keeps its count without power: a stored zero stays good
  double jig_position_rad = 0.0;    ///< actuator position in the jig
  double index_position_rad = 0.0;  ///< actuator position at one of the index pulses
  /// [design choice] After as many days a zero is doubtful, found by `sprung home` or not: screws creep, jigs
  /// wear.
  int max_age_days = 365;
};

/// Supply voltage that an actuator's drive may see; 0, 0 = not watched. Beyond it the robot is damped.
struct SupplyConfig {
  double min_V = 0.0;
  double max_V = 0.0;
};

/// A number of a node that is read by SDO once a second, beside the cycle.
struct ReadingConfig {
  std::uint16_t index = 0;  ///< 0 = there is none
  std::uint8_t sub = 0;
  int bytes = 0;  ///< 1, 2 or 4
  bool is_signed = false;
  double scale = 1.0;  ///< unit of the reading for one count

  double value(std::uint32_t raw) const noexcept {
    const int shift = 32 - 8 * bytes;
    const std::uint32_t high = raw << shift;
    return scale * (is_signed ? static_cast<double>(static_cast<std::int32_t>(high) >> shift)
                              : static_cast<double>(high >> shift));
  }
};

/// Thermal sensor that an actuator's drive shows. Beyond its limit the robot is stopped.
struct TemperatureConfig {
  ReadingConfig reading;  ///< degC
  double max_degC = 0.0;
};

/// A battery on one of the buses, that answers SDO (CiA 418, or objects of its maker).
struct BatteryConfig {
  int bus = -1;  ///< index into RobotConfig::buses; -1 = there is none
  int node = 0;
  ReadingConfig voltage;          ///< V
  ReadingConfig charge;           ///< share of its capacity, 0 to 1
  ReadingConfig temperature;      ///< degC
  double min_charge_share = 0.0;  ///< below, `sprung status` and the bridge's log warn
};

/// A digital input of an actuator's drive at which an emergency stop is read.
struct EmergencyInputConfig {
  int bit = -1;             ///< of the drive's object for its inputs; -1 = none
  bool stops_high = false;  ///< whether a 1 stops; a 0 is what a cut wire gives
};

/// Who closes an actuator's position loop.
enum class PositionLoopSide : std::int8_t {
  kDrive,  ///< the drive, in a position mode of its own
  kHost,   ///< the bridge; the drive takes torques alone
};

/// One drive with motor and gear. Actuator space: output side of the gear, after direction and offset.
struct ActuatorConfig {
  std::string name;
  int bus = 0;          ///< index into RobotConfig::buses
  int node = 0;         ///< CANopen node id, 1..126
  std::string profile;  ///< drivers/profiles/<profile>
  IdentityConfig identity;
  NodeWatch watch = NodeWatch::kHeartbeat;
  double gear_ratio = 0.0;             ///< motor turns per output turn, > 0
  double direction = 1.0;              ///< +1 or -1: sign of the motor's own forward in actuator space
  double torque_constant_Nm_A = 0.0;   ///< motor side, > 0
  double rated_current_A = 0.0;        ///< > 0; with the torque constant gives 0x6076
  double encoder_counts_per_turn = 0;  ///< of the motor shaft
  double offset_rad = 0.0;             ///< actuator position at encoder count zero
  bool referenced = false;             ///< torque is refused until true
  std::string referenced_on;           ///< when its zero was found, YYYY-MM-DD; empty: nobody has said
  double torque_limit_Nm = 0.0;        ///< gear output side
  double speed_limit_rad_s = 0.0;
  double power_limit_W = 0.0;            ///< mechanical, that it may give; 0 = not limited
  std::uint16_t speed_limit_object = 0;  ///< where the drive takes its speed cap; 0 = the drive's own stays
  /// Where the drive takes its own position limits, CiA 402's 0x607D; 0 = it is told none.
  std::uint16_t position_limits_object = 0;
  PositionLoopSide position_loop = PositionLoopSide::kDrive;
  double position_stiffness_Nm_rad = 0.0;  ///< position loop, in joint units; the profile converts
  double position_damping_Nm_s_rad = 0.0;
  std::uint16_t position_gains_object = 0;  ///< where the drive takes these gains; 0 = its own tuning stays
  double safety_damping_Nm_s_rad = 0.0;     ///< bridge's damping
  int pole_pairs = 0;                       ///< of the motor; 0 = the drive's own stays
  double winding_time_constant_s = 0.0;     ///< thermal, of the motor's winding; 0 = the drive's own stays
  SupplyConfig supply;
  EmergencyInputConfig emergency_input;
  CommissioningConfig commissioning;
  TemperatureConfig temperature;
  bool restore_settings = false;  ///< at an orderly end the drive gets back what boot has overwritten
  LinkEncoderConfig link_encoder;
  ReferenceConfig reference;
};

struct JointConfig {
  std::string name;
  double position_min_rad = 0.0;
  double position_max_rad = 0.0;
  double armature_kg_m2 = 0.0;                 ///< ratio^2 * rotor inertia, joint side
  double coulomb_friction_Nm = 0.0;            ///< the paper's, joint side: what its equation (6) subtracts
  std::string friction_source;                 ///< of that
  std::optional<IdentifiedFriction> friction;  ///< nothing: the joint is not identified
  JointUncertainty uncertainty;
  ThermalParameters thermal;  ///< of the gear; no time constant: its temperature is not known
  /// Nothing: a link encoder, if there is one, says nothing about torque.
  std::optional<GearTorsion> torsion;

  FrictionParameters papers_friction() const noexcept { return coulomb_alone(coulomb_friction_Nm); }
  /// The best that is known: identified, else the paper's.
  FrictionParameters estimated_friction() const noexcept {
    return friction ? friction->parameters : papers_friction();
  }
};

struct WatchdogConfig {
  double command_hold_s = 0.020;  ///< DRIVE_COMMAND stale: hold, then damping
  double command_stop_s = 0.200;  ///< then quick stop, latched
  double leg_command_s = 0.020;   ///< leg controller: then damping
  double joint_state_s = 0.020;   ///< estimator: a longer gap starts its filters anew
  int silent_cycles = 2;          ///< a drive's missing answers that are held
  int overruns_in_row = 10;
  double heartbeat_s = 0.005;           ///< bridge's producer and drives' producers
  double heartbeat_consumer_s = 0.020;  ///< in the drives, for the bridge's heartbeat
  double drive_heartbeat_s = 0.100;     ///< in the bridge, for the drives' heartbeats
};

/// Curve of the leg's length (hip to foot, straight down) in a jump: one Bezier of any degree.
struct JumpCurveConfig {
  double duration_s = 0.0;
  std::vector<double> lengths_m;  ///< control points
  double height_m = 0.0;          ///< that it jumps to, as measured; other heights scale from here
  double drift_m = 0.0;  ///< how far back it lands by itself where the hip is free, as measured; ways forward
                         ///< make up for it
};

/// At rest the sign of friction is unknown: there the compensation follows the sign of the virtual spring's
/// torque (errata E5). speed 0: it does not, as in the papers.
struct RestFrictionConfig {
  double speed_rad_s = 0.0;  ///< share of the rest law: exp(-(w / this)^2)
  double torque_Nm = 0.1;    ///< its smooth sign: tanh(spring's torque / this)
  double
      most = 0.0;  ///< share of friction that a joint which stays stuck may add (controller/stuck_friction.h)
};

/// Everything that differs between `paper` and `best`.
struct PresetConfig {
  std::string name;
  CompensatedFriction compensated_friction = CompensatedFriction::kPaper;
  double friction_compensation = 1.0;      ///< share of that friction
  double friction_smoothing_rad_s = 0.05;  ///< tanh(w / this)
  RestFrictionConfig rest_friction;
  double inertia_compensation = 0.0;  ///< share of armature times desired joint acceleration
  double stiffness_ramp_s = 0.0;      ///< in which stiffness and damping reach a new value; 0: at once
  StiffnessConfig compliance;         ///< of `sprung comply`; zero stiffness: it must be asked for
  double stand_length_m = 0.0;
  double sit_length_m = 0.0;
  double rise_time_s = 0.0;  ///< sit or unknown pose to stand
  double crouch_time_s = 0.0;
  double settle_time_s = 0.0;   ///< stand still before and after a jump
  double recover_time_s = 0.0;  ///< landing to stand
  double landing_hold_s = 0.0;  ///< compliance after touchdown before recovering
  double landing_length_m = 0.0;
  double flight_timeout_s = 0.0;
  double thrust_timeout_s = 0.0;
  double hybrid_switch_s = 0.0;  ///< earliest switch to compliance, since thrust began
  JumpCurveConfig jump_curve;
  bool adapt_height = false;       ///< jumps learn from the height that they are estimated to have reached
  StiffnessConfig torque_jump;     ///< torque mode: whole jump
  StiffnessConfig hybrid_landing;  ///< hybrid mode: from the switch on
  AdaptiveLandingConfig adaptive_landing;
  WalkConfig walk;  ///< of a robot with gaits

  /// Nothing to jump with: the preset has no jump_curve.
  bool jumps() const noexcept { return jump_curve.height_m > 0.0; }
};

/// What `sprung up` does when a process ends by itself.
enum class RestartPolicy {
  kNever,          ///< names it; the robot's own safety acts
  kWithoutTorque,  ///< starts it again as soon as the bridge says that no drive has torque; in real time only
};

/// A process that `sprung up` starts, in order; real-time priority 0 = none, cpu -1 = any.
struct ProcessConfig {
  std::string program;
  int priority = 0;
  int cpu = -1;
  RestartPolicy restart = RestartPolicy::kNever;
  std::string host;  ///< `sprung up --host` of that name starts it; empty = the host that has the bridge
};

/// A number that overlay.yaml replaced.
struct OverlaidNumber {
  std::string path;  ///< from the top of robot.yaml: "presets.best.stand_length"
  std::string unit;
  double file = 0.0;  ///< robot.yaml's own
  double value = 0.0;
};

struct RobotConfig {
  std::string name;
  std::string folder;  ///< where robot.yaml is
  double cycle_s = 0.0;
  std::vector<BusConfig> buses;
  double bit_rate_bit_s = 1e6;  ///< of every bus
  std::vector<ActuatorConfig> actuators;
  std::vector<EncoderCardConfig> encoder_cards;
  BatteryConfig battery;
  std::vector<JointConfig> joints;
  std::vector<LegConfig> legs;
  EstimationConfig estimation;
  WatchdogConfig watchdogs;             ///< on the robot, and in lock-step
  WatchdogConfig simulation_watchdogs;  ///< real time with --sim on a shared machine
  std::vector<PresetConfig> presets;
  BodyConfig body;
  std::vector<GaitConfig> gaits;
  std::vector<ProcessConfig> processes;
  bool hold_to_run = false;  ///< no key of the file: maintenance.h
  /// In which a robot that nobody plans for is let down; no key either. [design choice] design section 8,
  /// about 1.5 s until the drives are off: the bridge's margin and the time of rest come after it.
  double lowering_s = 1.2;
  std::int64_t hash = 0;                ///< of the file's bytes
  std::vector<OverlaidNumber> overlay;  ///< robots/overlay.h
  std::int64_t overlay_hash = 0;        ///< of those; 0: there are none

  /// Something is read for AUXILIARY_STATE.
  bool has_auxiliary_readings() const noexcept;
  /// Every leg can be stood on.
  bool has_feet() const { return why_not_standing() == nullptr; }
  /// Static text, nullptr for a robot that has feet.
  const char* why_not_standing() const;
  /// The joint beside this actuator in its leg, which it moves first of all; -1: no leg has it.
  int joint_of_actuator(int actuator) const noexcept;
  /// Without a name: the one called `best`, else the only one there is. Of a robot without feet, which needs
  /// no presets and may have none: one that moves nothing, whatever the name. @throws std::invalid_argument
  /// naming the presets there are.
  const PresetConfig& preset(const std::string& preset_name = "") const;
};

/// The robot as its processes know it under a preset. One that compensates the papers' friction is there to
/// reproduce the papers: no joint of it is identified, so that its figures do not depend on what `sprung
/// identify` writes.
/// @throws std::invalid_argument naming the presets there are.
RobotConfig as_in_preset(RobotConfig robot, const std::string& preset_name);

/// Name of `wished` where the robot has it, else of `otherwise`, which may be empty. @throws as
/// RobotConfig::preset.
std::string preset_or(const RobotConfig& robot, const std::string& wished, const std::string& otherwise = "");

}  // namespace sprung
