#pragma once
/// Enumerations that cross process boundaries. Values are part of the wire format: append, never renumber,
/// and give each its name in signals/mode_names.h.
#include <cstdint>

namespace sprung {

/// What a drive is asked to do, or shows that it does.
enum class DriveMode : std::int8_t {
  kDisabled = 0,  ///< no torque
  kDamping = 1,   ///< torque = -damping * velocity, computed in the bridge; shown by drives as kTorque
  kTorque = 2,
  kPosition = 3,
};

/// CiA 402 power state machine, decoded from the status word.
enum class PowerState : std::int8_t {
  kUnknown = 0,
  kNotReadyToSwitchOn = 1,
  kSwitchOnDisabled = 2,
  kReadyToSwitchOn = 3,
  kSwitchedOn = 4,
  kOperationEnabled = 5,
  kQuickStopActive = 6,
  kFaultReactionActive = 7,
  kFault = 8,
};

/// What the bridge lets the robot do.
enum class SafetyLevel : std::int8_t {
  kOperational = 0,
  kDamping = 1,    ///< bridge damps every actuator by itself
  kQuickStop = 2,  ///< drives' own quick stop, ends without power; latched
  kDisabled = 3,   ///< no power; latched when it has a cause
  kLowering = 4,   ///< leg controller lets the robot down by itself; latched
};

/// Worse is larger: operational, lowering, damping, quick stop, disabled.
constexpr int severity(SafetyLevel level) noexcept {
  if (level == SafetyLevel::kOperational) return 0;
  return level == SafetyLevel::kLowering ? 1 : static_cast<int>(level) + 1;
}
/// The bridge passes DRIVE_COMMANDs on.
constexpr bool obeys(SafetyLevel level) noexcept {
  return level == SafetyLevel::kOperational || level == SafetyLevel::kLowering;
}

enum class SafetyCause : std::int8_t {
  kNone = 0,
  kStarting = 1,
  kCommandStale = 2,
  kCommandRefused = 3,
  kDriveFault = 4,
  kDriveSilent = 5,
  kDriveRefused = 6,  ///< identity or settings differ from robot.yaml
  kBusLost = 7,
  kOverruns = 8,
  kEmergencyStop = 9,
  kShutdown = 10,
  kImplausible = 11,
  kDuplicateNode = 12,  ///< two devices answer for one node id
  kForeignMaster = 13,  ///< somebody else commands our drives
  kPlannerLost = 14,    ///< the leg controller gets no LEG_COMMAND
  kJointLimit = 15,     ///< a joint is far beyond its limits
  kOverspeed = 16,      ///< an actuator is far beyond its speed limit
  kWinding = 17,        ///< more current for longer than a motor's winding bears
  kSupply = 18,         ///< a drive's supply voltage is out of its range
};

enum class JointStatus : std::int8_t {
  kOk = 0,
  kStarting = 1,   ///< filter not settled
  kStale = 2,      ///< drive did not answer lately
  kSaturated = 3,  ///< drive at its torque limit
  kNotReferenced = 4,
  kFault = 5,
};

/// What of a joint's model explains best that its motion does not fit.
enum class MisfitReason : std::int8_t {
  kNone = 0,             ///< it fits
  kFriction = 1,         ///< the same at every speed
  kViscousFriction = 2,  ///< grows with speed
  kLoadFriction = 3,     ///< grows with the gear's load
  kInertia = 4,
  kTorqueConstant = 5,
  kWeight = 6,  ///< mass of the links, or something that hangs on them
};

enum class ControlMode : std::int8_t {
  kDisabled = 0,
  kDamping = 1,
  kPosition = 2,
  kCompliance = 3,
  kJoint = 4,  ///< the drives' position loops follow desired joint angles; needs no kinematics
};

/// Phase of one leg, named as in the papers.
enum class LegPhase : std::int8_t {
  kIdle = 0,
  kStand = 1,
  kCrouch = 2,
  kThrust = 3,
  kFlight = 4,
  kLanding = 5,
  kRecover = 6,
  kSwing = 7,
  kPreStance = 8,
  kStance = 9,
};

/// State of the robot's motion state machine.
enum class MotionPhase : std::int8_t {
  kIdle = 0,    ///< drives off
  kRising = 1,  ///< drives enabling, then moving to the stand
  kStanding = 2,
  kCrouch = 3,
  kThrust = 4,
  kFlight = 5,
  kLanding = 6,
  kRecover = 7,
  kSitting = 8,      ///< lowering (damped, where single joints were held), then off
  kMovingJoint = 9,  ///< one joint moves as such, or has; all others hold still
  kComplying = 10,   ///< each foot on a virtual spring with the operator's stiffness and damping
  kWalking = 11,     ///< in a gait, which may be standing on virtual springs
  kFallen = 12,      ///< a fall was detected: legs are damped
};

/// What befell a leg in a gait; each has a reaction (docs/locomotion.md).
enum class LegEvent : std::int8_t {
  kNone = 0,
  kEarlyContact = 1,  ///< the foot met the ground before the gait's clock said so
  kLateContact = 2,   ///< no ground where it was expected: the foot steps down
  kNoGround = 3,      ///< none within the limit of stepping down
  kSlip = 4,          ///< a standing foot moves
  kStumble = 5,       ///< a swinging foot is held up
};

/// How the legs of a gait are controlled.
enum class GaitControl : std::int8_t {
  kForce = 0,      ///< virtual springs throughout, also in swing
  kHybrid = 1,     ///< position in swing, virtual springs in stance, switched at the planned touchdown
  kPreStance = 2,  ///< the papers': hybrid, and soft before the planned touchdown
  kAdaptive = 3,   ///< hybrid with sprung's own pre-stance: slow approach, switched on contact
};

enum class JumpMode : std::int8_t {
  kPosition = 0,
  kTorque = 1,
  kHybrid = 2,
  kAdaptive = 3,  ///< hybrid with sprung's own landing: docs/control.md
};

enum class OperatorKind : std::int8_t {
  kNone = 0,
  kStand = 1,
  kJump = 2,
  kStop = 3,
  kEstop = 4,
  kClear = 5,
  kSit = 6,
  kHome = 7,       ///< bridge: reference the actuators
  kMoveJoint = 8,  ///< planner: one joint to an angle, the others hold still
  kComply = 9,     ///< planner: from standing or complying, a virtual spring at each foot
  kLand = 10,    ///< planner: from standing in the air, catch a fall that is expected to end at a given time
  kWalk = 11,    ///< planner: from standing or walking, a gait with speed and turning
  kHold = 12,    ///< planner: the operator is still there; renews a walk or comply that has begun with a hold
  kEnable = 13,  ///< planner, maintenance mode: the robot may move for hold_s (robots/maintenance.h)
  kSetParameter = 14,   ///< planner: another value, ramped (robots/parameters.h)
  kReadParameter = 15,  ///< planner: the next one that is not robot.yaml's
};

enum class OperatorOutcome : std::int8_t { kAccepted = 0, kRefused = 1, kDone = 2, kFailed = 3, kQueued = 4 };

enum class ProcessState : std::int8_t { kStarting = 0, kReady = 1, kRunning = 2, kStopping = 3 };

/// Of an IMU's sample.
enum class ImuStatus : std::int8_t {
  kStarting = 0,    ///< nothing measured yet: no number is good
  kGood = 1,        ///< every number
  kNoAttitude = 2,  ///< rates and specific force are good, the quaternion is NaN
  kFault = 3,       ///< the sensor says that its numbers are not good
};

enum class SimControlKind : std::int8_t {
  kWrench = 0,
  kReset = 1,
  kSuspend = 2,
  kDriveFault = 3,   ///< actuator's drive: emergency code `value`
  kDriveSilent = 4,  ///< cable of the actuator's drive
  kNodeFault = 5,  ///< `fault` of the actuator's drive or, with actuator -1, of bus `bus`; for duration_s, 0
                   ///< = for good
  kFloor = 6,      ///< height of the floor in the world: `value`, m; `actuator` n >= 0: under leg n alone
  kImu = 7,        ///< `value` 0: it works; 1: silent; 2: says kFault; 3: no attitude; 4: frozen;
                   ///< 5: a spike in each 50th sample
};

/// Faults on demand (`sprung fault`). `value` where one is given; others ignore it.
enum class FaultKind : std::int8_t {
  kNone = 0,
  kOverCurrent = 1,
  kUnderVoltage = 2,
  kOverTemperature = 3,
  kEncoderStuck = 4,
  kEncoderJump = 5,        ///< value: rad of the output, once
  kEncoderNoise = 6,       ///< value: rms rad of the output
  kCurrentOffset = 7,      ///< value: A
  kFramesLost = 8,         ///< value: share of the node's (or bus's) frames, 0..1
  kFramesLate = 9,         ///< value: seconds
  kFramesDuplicated = 10,  ///< value: share
  kFramesFlipped = 11,     ///< value: share; one bit of the data
  kHeartbeatStopped = 12,
  kBusOff = 13,
  kErrorPassive = 14,
  kPowerCycle = 15,
  kDuplicateNode = 16,  ///< a second device with this node id answers too
  kShortPdo = 17,       ///< the node's sample comes a byte short
  kLinkDown = 18,
  kQueueFull = 19,       ///< ENOBUFS at the master
  kEmergencyInput = 20,  ///< the emergency stop at the drive's input is pressed, or its wire is cut
};

/// State of one CAN bus as its controller and the bridge's traffic show it; worse is larger.
enum class BusCondition : std::int8_t {
  kActive = 0,
  kWarning = 1,    ///< error counters above 96
  kPassive = 2,    ///< above 128
  kNoBuffers = 3,  ///< the interface's queue is full (ENOBUFS)
  kLinkDown = 4,
  kOff = 5,  ///< bus off
};

/// Where `sprung home` takes an actuator's zero from; kConfigured = as robot.yaml says for each.
enum class ReferenceSource : std::int8_t { kConfigured = 0, kLink = 1, kIndex = 2, kJig = 3 };

/// Why a log file ends. A file without LOG_END was cut off: its recorder was killed, or the machine went
/// down.
enum class LogEndReason : std::int8_t {
  kAsked = 0,       ///< by the operator or the launcher
  kContinued = 1,   ///< the recording goes on in the next part
  kDiskGuard = 2,   ///< the disk was nearly full
  kWriteError = 3,  ///< the disk refused to take more
};

}  // namespace sprung

#include "signals/mode_names.h"  // name() of each; last, since its tables need the values
