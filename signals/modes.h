#pragma once
/// Enumerations that cross process boundaries. Values are part of the wire format: append, never renumber.
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

/// What the bridge lets the robot do; worse is larger.
enum class SafetyLevel : std::int8_t {
  kOperational = 0,
  kDamping = 1,    ///< bridge damps every actuator by itself
  kQuickStop = 2,  ///< drives' own quick stop, ends without power; latched
  kDisabled = 3,   ///< no power; latched when it has a cause
};

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
};

enum class JointStatus : std::int8_t {
  kOk = 0,
  kStarting = 1,   ///< filter not settled
  kStale = 2,      ///< drive did not answer lately
  kSaturated = 3,  ///< drive at its torque limit
  kNotReferenced = 4,
  kFault = 5,
};

enum class ControlMode : std::int8_t { kDisabled = 0, kDamping = 1, kPosition = 2, kCompliance = 3 };

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
  kSitting = 8,  ///< lowering, then off
};

enum class JumpMode : std::int8_t { kPosition = 0, kTorque = 1, kHybrid = 2 };

enum class OperatorKind : std::int8_t {
  kNone = 0,
  kStand = 1,
  kJump = 2,
  kStop = 3,
  kEstop = 4,
  kClear = 5,
  kSit = 6
};

enum class OperatorOutcome : std::int8_t { kAccepted = 0, kRefused = 1, kDone = 2, kFailed = 3, kQueued = 4 };

enum class ProcessState : std::int8_t { kStarting = 0, kReady = 1, kRunning = 2, kStopping = 3 };

enum class SimControlKind : std::int8_t {
  kWrench = 0,
  kReset = 1,
  kSuspend = 2,
  kDriveFault = 3,
  kDriveSilent = 4
};

const char* name(DriveMode value) noexcept;
const char* name(PowerState value) noexcept;
const char* name(SafetyLevel value) noexcept;
const char* name(SafetyCause value) noexcept;
const char* name(JointStatus value) noexcept;
const char* name(ControlMode value) noexcept;
const char* name(LegPhase value) noexcept;
const char* name(MotionPhase value) noexcept;
const char* name(JumpMode value) noexcept;
const char* name(OperatorKind value) noexcept;
const char* name(OperatorOutcome value) noexcept;
const char* name(ProcessState value) noexcept;

}  // namespace sprung
