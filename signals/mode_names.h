#pragma once
/// Each mode in words. For people, logs and options: a name that was printed once stays.
#include "signals/enumeration.h"
#include "signals/modes.h"

namespace sprung {

constexpr auto words_of(DriveMode) {
  using E = DriveMode;
  return words<E>({{E::kDisabled, "disabled"},
                   {E::kDamping, "damping"},
                   {E::kTorque, "torque"},
                   {E::kPosition, "position"}});
}

constexpr auto words_of(PowerState) {
  using E = PowerState;
  return words<E>({{E::kUnknown, "unknown"},
                   {E::kNotReadyToSwitchOn, "not ready to switch on"},
                   {E::kSwitchOnDisabled, "switch on disabled"},
                   {E::kReadyToSwitchOn, "ready to switch on"},
                   {E::kSwitchedOn, "switched on"},
                   {E::kOperationEnabled, "operation enabled"},
                   {E::kQuickStopActive, "quick stop active"},
                   {E::kFaultReactionActive, "fault reaction active"},
                   {E::kFault, "fault"}});
}

constexpr auto words_of(SafetyLevel) {
  using E = SafetyLevel;
  return words<E>({{E::kOperational, "operational"},
                   {E::kDamping, "damping"},
                   {E::kQuickStop, "quick stop"},
                   {E::kDisabled, "disabled"},
                   {E::kLowering, "lowering"}});
}

constexpr auto words_of(SafetyCause) {
  using E = SafetyCause;
  return words<E>({{E::kNone, "none"},
                   {E::kStarting, "starting"},
                   {E::kCommandStale, "command stale"},
                   {E::kCommandRefused, "command refused"},
                   {E::kDriveFault, "drive fault"},
                   {E::kDriveSilent, "drive silent"},
                   {E::kDriveRefused, "drive refused"},
                   {E::kBusLost, "bus lost"},
                   {E::kOverruns, "overruns"},
                   {E::kEmergencyStop, "emergency stop"},
                   {E::kShutdown, "shutdown"},
                   {E::kImplausible, "implausible"},
                   {E::kDuplicateNode, "duplicate node id"},
                   {E::kForeignMaster, "another master"},
                   {E::kPlannerLost, "planner lost"},
                   {E::kJointLimit, "joint limit"},
                   {E::kOverspeed, "overspeed"},
                   {E::kWinding, "winding"},
                   {E::kSupply, "supply"}});
}

constexpr auto words_of(JointStatus) {
  using E = JointStatus;
  return words<E>({{E::kOk, "ok"},
                   {E::kStarting, "starting"},
                   {E::kStale, "stale"},
                   {E::kSaturated, "saturated"},
                   {E::kNotReferenced, "not referenced"},
                   {E::kFault, "fault"}});
}

constexpr auto words_of(MisfitReason) {
  using E = MisfitReason;
  return words<E>({{E::kNone, "none"},
                   {E::kFriction, "friction"},
                   {E::kViscousFriction, "viscous friction"},
                   {E::kLoadFriction, "load friction"},
                   {E::kInertia, "inertia"},
                   {E::kTorqueConstant, "torque constant"},
                   {E::kWeight, "weight"}});
}

constexpr auto words_of(ControlMode) {
  using E = ControlMode;
  return words<E>({{E::kDisabled, "disabled"},
                   {E::kDamping, "damping"},
                   {E::kPosition, "position"},
                   {E::kCompliance, "compliance"},
                   {E::kJoint, "joint"}});
}

constexpr auto words_of(LegPhase) {
  using E = LegPhase;
  return words<E>({{E::kIdle, "idle"},
                   {E::kStand, "stand"},
                   {E::kCrouch, "crouch"},
                   {E::kThrust, "thrust"},
                   {E::kFlight, "flight"},
                   {E::kLanding, "landing"},
                   {E::kRecover, "recover"},
                   {E::kSwing, "swing"},
                   {E::kPreStance, "pre stance"},
                   {E::kStance, "stance"}});
}

constexpr auto words_of(MotionPhase) {
  using E = MotionPhase;
  return words<E>({{E::kIdle, "idle"},
                   {E::kRising, "rising"},
                   {E::kStanding, "standing"},
                   {E::kCrouch, "crouch"},
                   {E::kThrust, "thrust"},
                   {E::kFlight, "flight"},
                   {E::kLanding, "landing"},
                   {E::kRecover, "recover"},
                   {E::kSitting, "sitting"},
                   {E::kMovingJoint, "moving joint"},
                   {E::kComplying, "complying"},
                   {E::kWalking, "walking"},
                   {E::kFallen, "fallen"}});
}

constexpr auto words_of(LegEvent) {
  using E = LegEvent;
  return words<E>({{E::kNone, "none"},
                   {E::kEarlyContact, "early contact"},
                   {E::kLateContact, "late contact"},
                   {E::kNoGround, "no ground"},
                   {E::kSlip, "slip"},
                   {E::kStumble, "stumble"}});
}

constexpr auto words_of(GaitControl) {
  using E = GaitControl;
  return words<E>({{E::kForce, "force"},
                   {E::kHybrid, "hybrid"},
                   {E::kPreStance, "prestance"},
                   {E::kAdaptive, "adaptive"}});
}

constexpr auto words_of(JumpMode) {
  using E = JumpMode;
  return words<E>({{E::kPosition, "position"},
                   {E::kTorque, "torque"},
                   {E::kHybrid, "hybrid"},
                   {E::kAdaptive, "adaptive"}});
}

constexpr auto words_of(OperatorKind) {
  using E = OperatorKind;
  return words<E>({{E::kNone, "none"},
                   {E::kStand, "stand"},
                   {E::kJump, "jump"},
                   {E::kStop, "stop"},
                   {E::kEstop, "estop"},
                   {E::kClear, "clear"},
                   {E::kSit, "sit"},
                   {E::kHome, "home"},
                   {E::kMoveJoint, "move joint"},
                   {E::kComply, "comply"},
                   {E::kLand, "land"},
                   {E::kWalk, "walk"},
                   {E::kHold, "hold"},
                   {E::kEnable, "enable"},
                   {E::kSetParameter, "set parameter"},
                   {E::kReadParameter, "read parameter"}});
}

constexpr auto words_of(OperatorOutcome) {
  using E = OperatorOutcome;
  return words<E>({{E::kAccepted, "accepted"},
                   {E::kRefused, "refused"},
                   {E::kDone, "done"},
                   {E::kFailed, "failed"},
                   {E::kQueued, "queued"}});
}

constexpr auto words_of(ProcessState) {
  using E = ProcessState;
  return words<E>({{E::kStarting, "starting"},
                   {E::kReady, "ready"},
                   {E::kRunning, "running"},
                   {E::kStopping, "stopping"}});
}

constexpr auto words_of(ImuStatus) {
  using E = ImuStatus;
  return words<E>({{E::kStarting, "starting"},
                   {E::kGood, "good"},
                   {E::kNoAttitude, "no attitude"},
                   {E::kFault, "fault"}});
}

constexpr auto words_of(SimControlKind) {
  using E = SimControlKind;
  return words<E>({{E::kWrench, "wrench"},
                   {E::kReset, "reset"},
                   {E::kSuspend, "suspend"},
                   {E::kDriveFault, "drive fault"},
                   {E::kDriveSilent, "drive silent"},
                   {E::kNodeFault, "node fault"},
                   {E::kFloor, "floor"},
                   {E::kImu, "imu"}});
}

constexpr auto words_of(FaultKind) {
  using E = FaultKind;
  return words<E>({{E::kNone, "none"},
                   {E::kOverCurrent, "over-current"},
                   {E::kUnderVoltage, "under-voltage"},
                   {E::kOverTemperature, "over-temperature"},
                   {E::kEncoderStuck, "encoder-stuck"},
                   {E::kEncoderJump, "encoder-jump"},
                   {E::kEncoderNoise, "encoder-noise"},
                   {E::kCurrentOffset, "current-offset"},
                   {E::kFramesLost, "frames-lost"},
                   {E::kFramesLate, "frames-late"},
                   {E::kFramesDuplicated, "frames-duplicated"},
                   {E::kFramesFlipped, "frames-flipped"},
                   {E::kHeartbeatStopped, "heartbeat-stopped"},
                   {E::kBusOff, "bus-off"},
                   {E::kErrorPassive, "error-passive"},
                   {E::kPowerCycle, "power-cycle"},
                   {E::kDuplicateNode, "duplicate-node"},
                   {E::kShortPdo, "short-pdo"},
                   {E::kLinkDown, "link-down"},
                   {E::kQueueFull, "queue-full"},
                   {E::kEmergencyInput, "emergency-input"}});
}

constexpr auto words_of(BusCondition) {
  using E = BusCondition;
  return words<E>({{E::kActive, "active"},
                   {E::kWarning, "warning"},
                   {E::kPassive, "error passive"},
                   {E::kNoBuffers, "queue full"},
                   {E::kLinkDown, "link down"},
                   {E::kOff, "bus off"}});
}

constexpr auto words_of(ReferenceSource) {
  using E = ReferenceSource;
  return words<E>(
      {{E::kConfigured, "configured"}, {E::kLink, "link"}, {E::kIndex, "index"}, {E::kJig, "jig"}});
}

constexpr auto words_of(LogEndReason) {
  using E = LogEndReason;
  return words<E>({{E::kAsked, "asked for"},
                   {E::kContinued, "goes on in the next part"},
                   {E::kDiskGuard, "the disk was nearly full"},
                   {E::kWriteError, "the disk took no more"}});
}

/// LEG_STATE counts each kind of event by its value.
inline constexpr std::size_t kLegEventCount = kWords<LegEvent>.size();

}  // namespace sprung
