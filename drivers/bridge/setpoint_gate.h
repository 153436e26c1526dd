#pragma once
/// The last that looks at a set-point before the bus: joint limits, speed, rate, power and winding. The leg
/// controller keeps tighter limits of its own (controller/torque_limits.h); this holds them against whoever
/// commands, and touches nothing that a healthy controller sends. Each that acts is counted. Pure.
///
///   limit           torque control                                position control
///   joint position  braked in time; beyond it none further out    joint set-points within the limits
///   speed           1.05 times the limit: none that makes faster
///   rate            zero to full torque in 3.8 ms; down at once   twice the speed limit; from where it is
///   power           1.1 times the limit, where there is one
///   winding         warm: rated current (winding_watch.h)
#include <array>
#include <cstdint>
#include <vector>

#include "model/transmission.h"
#include "robots/robot_config.h"
#include "signals/bus_state.h"
#include "signals/drive_command.h"

namespace sprung {

enum class GateLimit : std::int8_t { kJointPosition, kSpeed, kRate, kPower, kWinding };
inline constexpr std::size_t kGateLimits = 5;
using GateCounts = std::array<std::int64_t, kGateLimits>;  ///< cycles in which each acted, since start

/// What the gate knows of an actuator in this cycle.
struct GateMotion {
  double measured_position_rad = kNaN;   ///< NaN: not referenced, or no sample of this cycle
  double filtered_velocity_rad_s = 0.0;  ///< 0 where it is not trusted
  double measured_torque_Nm = kNaN;      ///< by current: ratio times motor torque
  bool enabled = false;
  bool warm = false;  ///< its winding
};

class SetpointGate {
 public:
  /// Of the speed limit: above it nothing makes an actuator faster [design choice].
  static constexpr double kSpeedShare = 1.05;

  explicit SetpointGate(const RobotConfig& robot);

  /// Once a cycle; changes `commands` in place where a limit acts. Commands have passed the CommandGate.
  void limit(const std::vector<GateMotion>& motion, std::vector<ActuatorCommand>& commands) noexcept;
  /// Another than the command acts in this cycle: what was set before says nothing any more.
  void forget() noexcept;
  const GateCounts& counts(std::size_t actuator) const noexcept { return drives_[actuator].counts; }
  /// Adds the counts to the health of the actuator's node.
  void show(std::size_t actuator, NodeHealth& out) const noexcept;

 private:
  struct Drive {
    ActuatorConfig config;
    double most_step_Nm;          ///< of its torque in a cycle
    double set_torque_Nm = kNaN;  ///< of the cycle before, in torque control
    double set_position_rad = kNaN;
    GateCounts counts{};
  };
  struct Leg {
    Transmission transmission;
    std::vector<int> actuators;
    std::vector<JointConfig> joints;
    JointVector torque_bound_Nm;  ///< of each joint, by the limits of its actuators
  };
  using Commands = std::vector<ActuatorCommand>;
  using Motions = std::vector<GateMotion>;

  void within_joint_limits(const Leg& leg, const Motions& motion, Commands& commands) noexcept;
  void hold_positions(const Leg& leg, const JointVector& measured_rad, Commands& commands) noexcept;
  void hold_torques(const Leg& leg, const JointVector& measured_rad, const Motions& motion,
                    Commands& commands) noexcept;
  double torque_of(Drive& drive, const GateMotion& motion, double torque_Nm) noexcept;
  double position_of(Drive& drive, const GateMotion& motion, double position_rad) noexcept;
  void count(int actuator, GateLimit limit) noexcept { ++drives_[actuator].counts[index(limit)]; }
  static constexpr std::size_t index(GateLimit limit) noexcept { return static_cast<std::size_t>(limit); }

  double cycle_s_;
  std::vector<Drive> drives_;
  std::vector<Leg> legs_;
};

}  // namespace sprung
