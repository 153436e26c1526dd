#pragma once
/// The values that cores exchange: plain structs, one for each channel of lcmtypes/README.md, where every
/// field's unit and frame is stated. Vectors are sized once (by the constructors' counts) so that a step
/// allocates nothing.
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "signals/modes.h"
#include "signals/stamp.h"

namespace sprung {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
using Vec3 = std::array<double, 3>;

struct ActuatorState {
  double measured_position_rad = kNaN;       ///< output side of the gear, sign and offset applied
  double measured_link_position_rad = kNaN;  ///< NaN where there is no link encoder
  double measured_velocity_rad_s = kNaN;     ///< NaN unless the drive sends it
  double measured_current_A = kNaN;
  double measured_supply_V = kNaN;
  std::int32_t fault_code = 0;
  std::int32_t age_cycles = 0;
  PowerState power_state = PowerState::kUnknown;
  DriveMode shown_mode = DriveMode::kDisabled;
  bool referenced = false;
};

struct DriveState {
  Stamp stamp;
  std::vector<ActuatorState> actuators;
  SafetyLevel safety = SafetyLevel::kDisabled;
  DriveState() = default;
  explicit DriveState(std::size_t actuator_count) : actuators(actuator_count) {}
};

struct ActuatorCommand {
  double commanded_torque_Nm = 0.0;
  double commanded_position_rad = kNaN;
  double commanded_velocity_rad_s = 0.0;
  double commanded_damping_Nm_s_rad = 0.0;
  DriveMode mode = DriveMode::kDisabled;
};

struct DriveCommand {
  Stamp stamp;
  std::vector<ActuatorCommand> actuators;
  std::int64_t valid_until_utime_us = 0;
  std::int64_t used_joint_state_seq = -1;
  std::int64_t used_leg_command_seq = -1;
  DriveCommand() = default;
  explicit DriveCommand(std::size_t actuator_count) : actuators(actuator_count) {}
};

struct EstimatedJoint {
  double estimated_position_rad = kNaN;
  double estimated_velocity_rad_s = kNaN;
  double estimated_acceleration_rad_s2 = kNaN;
  double motor_side_torque_Nm = kNaN;
  double gear_output_torque_Nm = kNaN;
  double gear_output_torque_bound_Nm = kNaN;
  double friction_torque_Nm = kNaN;
  double external_torque_Nm = kNaN;
  double estimated_position_bound_rad = kNaN;
  double estimated_velocity_bound_rad_s = kNaN;
  double estimated_acceleration_bound_rad_s2 = kNaN;
  double friction_torque_bound_Nm = kNaN;
  double external_torque_bound_Nm = kNaN;
  double torsion_torque_Nm = kNaN;  ///< from motor and link encoder; NaN where there is no link encoder
  double estimated_temperature_degC = kNaN;
  JointStatus status = JointStatus::kStarting;
  bool drive_enabled = false;
  bool identified = false;  ///< friction and armature come from `sprung identify`
  bool at_rest = false;  ///< friction's sign is not known: torques are the last possible, bounds the far end
};

struct EstimatedLeg {
  Vec3 estimated_foot_in_hip_m{kNaN, kNaN, kNaN};
  Vec3 estimated_foot_velocity_m_s{kNaN, kNaN, kNaN};
  Vec3 foot_force_N{kNaN, kNaN, kNaN};
  Vec3 foot_force_bound_N{kNaN, kNaN, kNaN};
  double contact_confidence = 0.0;
  bool contact = false;
};

/// Attitude and motion of the trunk. Trunk axes: x forward, y left, z up; yaw counts from the first sample.
struct EstimatedBody {
  std::array<double, 4> estimated_quaternion_wxyz{kNaN, kNaN, kNaN,
                                                  kNaN};    ///< turns trunk axes into world axes
  Vec3 estimated_angular_velocity_rad_s{kNaN, kNaN, kNaN};  ///< trunk axes
  Vec3 estimated_velocity_m_s{kNaN, kNaN, kNaN};            ///< trunk axes; NaN while no foot stands
  double estimated_height_m = kNaN;  ///< of the trunk's hips' middle over the feet that stand
  bool uses_imu = false;             ///< false: attitude is that of the plane through the standing feet
};

struct JointState {
  Stamp stamp;
  EstimatedBody body;
  std::vector<EstimatedJoint> joints;
  std::vector<EstimatedLeg> legs;
  SafetyLevel safety = SafetyLevel::kDisabled;
  std::int64_t used_drive_state_seq = -1;
  std::int64_t used_imu_seq = -1;  ///< newest that had come; -1 = none yet, or a robot without body.imu
  JointState() = default;
  JointState(std::size_t joint_count, std::size_t leg_count) : joints(joint_count), legs(leg_count) {}
};

struct DesiredLeg {
  Vec3 desired_foot_in_hip_m{kNaN, kNaN, kNaN};
  Vec3 desired_foot_velocity_m_s{0, 0, 0};
  Vec3 desired_foot_acceleration_m_s2{0, 0, 0};
  Vec3 stiffness_N_m{0, 0, 0};
  Vec3 damping_N_s_m{0, 0, 0};
  Vec3 feedforward_force_N{0, 0, 0};
  double friction_compensation = 0.0;
  double velocity_feedforward = 0.0;
  double inertia_compensation = 0.0;
  Vec3 desired_joint_position_rad{kNaN, kNaN, kNaN};  ///< ControlMode::kJoint only, the leg's joints in order
  Vec3 desired_joint_velocity_rad_s{0, 0, 0};
  LegPhase phase = LegPhase::kIdle;
  ControlMode control_mode = ControlMode::kDisabled;
};

struct LegCommand {
  Stamp stamp;
  std::vector<DesiredLeg> legs;
  std::int64_t used_joint_state_seq = -1;
  LegCommand() = default;
  explicit LegCommand(std::size_t leg_count) : legs(leg_count) {}
};

struct MotionLeg {
  LegPhase phase = LegPhase::kIdle;
  double phase_time_s = 0.0;
  LegEvent last_event = LegEvent::kNone;                    ///< in this gait
  std::array<std::int32_t, kLegEventCount> event_counts{};  ///< since the planner began, by LegEvent
};

struct MotionState {
  Stamp stamp;
  std::vector<MotionLeg> legs;
  MotionPhase state = MotionPhase::kIdle;
  std::int32_t jumps_done = 0;
  std::int32_t jumps_left = 0;
  double jump_height_scale = 1.0;
  double estimated_jump_height_m = kNaN;  ///< of the last jump, from its flight time and leg lengths
  JumpMode jump_mode = JumpMode::kHybrid;
  std::int32_t gait = -1;            ///< index into the robot's gaits; -1 = none
  double gait_phase = 0.0;           ///< share of the gait's period, 0..1
  Vec3 desired_speed{0, 0, 0};       ///< forward m/s, left m/s, turning rad/s; as ramped
  const char* last_transition = "";  ///< points to static text
  MotionState() = default;
  explicit MotionState(std::size_t leg_count) : legs(leg_count) {}
};

struct SafetyState {
  Stamp stamp;
  SafetyLevel level = SafetyLevel::kDisabled;
  SafetyCause cause = SafetyCause::kStarting;
  bool latched = false;
  std::int32_t actuator = -1;
  std::int64_t since_seq = -1;
  std::int64_t commands_refused = 0;
  std::int64_t overruns = 0;
  std::int64_t missed_cycles = 0;
  std::array<char, 160> detail{};  ///< zero-terminated; fixed size so that a cycle allocates nothing
};

/// Counters since the bridge began, unless said otherwise.
struct BusHealth {
  BusCondition condition = BusCondition::kActive;
  double load_share = 0.0;  ///< worst-case bits of all frames seen over the bit rate, last second
  std::int64_t sent = 0;    ///< frames
  std::int64_t received = 0;
  std::int64_t send_failed = 0;  ///< not taken by the kernel, all reasons
  std::int64_t no_buffers = 0;   ///< of these: ENOBUFS
  std::int64_t dropped = 0;      ///< lost before the bridge read them
  std::int64_t malformed = 0;
  std::int64_t unexpected = 0;  ///< from an id that no node of the robot has
  std::int64_t error_frames = 0;
  std::int64_t bus_offs = 0;
  std::int64_t restarts = 0;
};

struct NodeHealth {
  std::int32_t bus = 0;
  std::int32_t node = 0;
  std::int32_t actuator = -1;            ///< -1 = an encoder card
  std::int32_t last_emergency_code = 0;  ///< newest that was not 0, also when it is gone
  std::int32_t error_register = 0;
  std::int64_t emergencies = 0;
  std::int64_t boot_ups = 0;             ///< that nobody asked for
  std::int64_t missing_samples = 0;      ///< SYNCs without an answer
  std::int64_t late_samples = 0;         ///< that came after their cycle
  std::int64_t short_frames = 0;         ///< process data of the wrong length; ignored
  std::int64_t duplicate_samples = 0;    ///< a second answer to one SYNC
  std::int64_t implausible_samples = 0;  ///< that cannot be measured positions; kept out
  std::int64_t heartbeat_losses = 0;
  std::int64_t sdo_failures = 0;       ///< aborted or unanswered
  double reference_offset_rad = kNaN;  ///< offset in force; NaN where not referenced
  std::int8_t nmt_state = -1;          ///< CiA 301 state byte; -1 = not known
  ReferenceSource reference_source = ReferenceSource::kConfigured;
  bool operational = false;
  std::array<char, 128> recovery{};  ///< what the last clear did to this node, zero-terminated
};

struct BusState {
  Stamp stamp;
  std::vector<BusHealth> buses;
  std::vector<NodeHealth> nodes;  ///< actuators' drives in their order, then encoder cards
  bool recovering = false;        ///< a clear is under way
  BusState() = default;
  BusState(std::size_t bus_count, std::size_t node_count) : buses(bus_count), nodes(node_count) {}
};

struct OperatorCommand {
  Stamp stamp;
  std::int64_t request_id = 0;
  std::int64_t apply_at_seq = -1;
  OperatorKind kind = OperatorKind::kNone;
  JumpMode jump_mode = JumpMode::kHybrid;
  std::int32_t jump_count = 1;
  double jump_height_m = 0.0;
  double jump_forward_m = 0.0;           ///< where the foot lands, ahead of where it left
  Vec3 stiffness_N_m{kNaN, kNaN, kNaN};  ///< kComply; NaN: the preset's
  Vec3 damping_N_s_m{kNaN, kNaN, kNaN};  ///< kComply; NaN: the preset's
  double friction_compensation = kNaN;   ///< kComply; NaN: the preset's
  double touchdown_in_s = kNaN;          ///< kLand: from the cycle in which it takes effect
  std::int32_t actuator = -1;            ///< kHome: -1 = all
  std::int32_t joint = -1;               ///< kMoveJoint: index into the robot's joints
  double joint_target_rad = kNaN;
  double joint_speed_rad_s = kNaN;
  double joint_acceleration_rad_s2 = kNaN;
  ReferenceSource reference_source = ReferenceSource::kConfigured;
  std::int32_t gait = -1;                        ///< kWalk: index into the robot's gaits
  Vec3 walk_speed{0, 0, 0};                      ///< kWalk: forward m/s, left m/s, turning rad/s
  double body_height_m = kNaN;                   ///< kWalk; NaN: the preset's
  double stance_width_m = kNaN;                  ///< kWalk: added to each side; NaN: the preset's
  GaitControl gait_control = GaitControl::kOwn;  ///< kWalk
};

struct OperatorReply {
  Stamp stamp;
  std::int64_t request_id = 0;
  std::int64_t took_effect_at_seq = -1;
  OperatorOutcome outcome = OperatorOutcome::kRefused;
  const char* from = "";    ///< static text
  const char* reason = "";  ///< static text
};

struct SimControl {
  Stamp stamp;
  std::int64_t apply_at_seq = -1;
  std::array<double, 6> wrench{};
  double duration_s = 0.0;
  SimControlKind kind = SimControlKind::kWrench;
  std::int32_t actuator = -1;
  std::int32_t bus = -1;
  FaultKind fault = FaultKind::kNone;
  double value = 0.0;
};

struct TrueJoint {
  double true_position_rad = kNaN;
  double true_velocity_rad_s = kNaN;
  double true_acceleration_rad_s2 = kNaN;
  double true_motor_torque_Nm = kNaN;
  double true_gear_output_torque_Nm = kNaN;
  double true_friction_torque_Nm = kNaN;
  double true_motor_position_rad = kNaN;  ///< of the rotor, output side: differs by the gear's torsion
  double true_temperature_degC = kNaN;    ///< of the gear, where the plant has one
};

struct TrueLeg {
  Vec3 true_foot_in_world_m{};
  Vec3 true_contact_force_N{};
  double true_ground_height_m = 0.0;  ///< of the floor under the foot, world
};

struct SimTruth {
  Stamp stamp;
  std::vector<TrueJoint> joints;
  std::vector<TrueLeg> legs;
  Vec3 base_in_world_m{};
  Vec3 base_velocity_m_s{};
  std::array<double, 4> base_quaternion_wxyz{1, 0, 0, 0};  ///< base axes to world axes
  Vec3 base_angular_velocity_rad_s{};                      ///< base axes
  Vec3 com_in_world_m{};                                   ///< of the whole robot
  Vec3 com_velocity_m_s{};
  SimTruth() = default;
  SimTruth(std::size_t joint_count, std::size_t leg_count) : joints(joint_count), legs(leg_count) {}
};

/// An IMU on the trunk, in trunk axes (x forward, y left, z up), sampled at the SYNC of its cycle.
struct Imu {
  Stamp stamp;
  Vec3 measured_angular_velocity_rad_s{kNaN, kNaN, kNaN};
  Vec3 measured_specific_force_m_s2{kNaN, kNaN, kNaN};                     ///< at rest +9.81 up
  std::array<double, 4> measured_quaternion_wxyz{kNaN, kNaN, kNaN, kNaN};  ///< trunk axes to world axes
  ImuStatus status = ImuStatus::kStarting;
};

/// A torque sensor between a gear and its link, as measured: it may be slower than the cycle.
struct TorqueSensor {
  Stamp stamp;  ///< of the reading; seq of the cycle that it fell into
  std::int32_t joint = -1;
  double measured_torque_Nm = kNaN;  ///< of the gear on the link, sign of gear_output_torque_Nm
};

}  // namespace sprung
