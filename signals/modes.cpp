#include "signals/modes.h"

namespace sprung {

const char* name(DriveMode value) noexcept {
  switch (value) {
    case DriveMode::kDisabled:
      return "disabled";
    case DriveMode::kDamping:
      return "damping";
    case DriveMode::kTorque:
      return "torque";
    case DriveMode::kPosition:
      return "position";
  }
  return "unknown";
}

const char* name(PowerState value) noexcept {
  switch (value) {
    case PowerState::kUnknown:
      return "unknown";
    case PowerState::kNotReadyToSwitchOn:
      return "not ready to switch on";
    case PowerState::kSwitchOnDisabled:
      return "switch on disabled";
    case PowerState::kReadyToSwitchOn:
      return "ready to switch on";
    case PowerState::kSwitchedOn:
      return "switched on";
    case PowerState::kOperationEnabled:
      return "operation enabled";
    case PowerState::kQuickStopActive:
      return "quick stop active";
    case PowerState::kFaultReactionActive:
      return "fault reaction active";
    case PowerState::kFault:
      return "fault";
  }
  return "unknown";
}

const char* name(SafetyLevel value) noexcept {
  switch (value) {
    case SafetyLevel::kOperational:
      return "operational";
    case SafetyLevel::kDamping:
      return "damping";
    case SafetyLevel::kQuickStop:
      return "quick stop";
    case SafetyLevel::kDisabled:
      return "disabled";
  }
  return "unknown";
}

const char* name(SafetyCause value) noexcept {
  switch (value) {
    case SafetyCause::kNone:
      return "none";
    case SafetyCause::kStarting:
      return "starting";
    case SafetyCause::kCommandStale:
      return "command stale";
    case SafetyCause::kCommandRefused:
      return "command refused";
    case SafetyCause::kDriveFault:
      return "drive fault";
    case SafetyCause::kDriveSilent:
      return "drive silent";
    case SafetyCause::kDriveRefused:
      return "drive refused";
    case SafetyCause::kBusLost:
      return "bus lost";
    case SafetyCause::kOverruns:
      return "overruns";
    case SafetyCause::kEmergencyStop:
      return "emergency stop";
    case SafetyCause::kShutdown:
      return "shutdown";
    case SafetyCause::kImplausible:
      return "implausible";
    case SafetyCause::kDuplicateNode:
      return "duplicate node id";
  }
  return "unknown";
}

const char* name(JointStatus value) noexcept {
  switch (value) {
    case JointStatus::kOk:
      return "ok";
    case JointStatus::kStarting:
      return "starting";
    case JointStatus::kStale:
      return "stale";
    case JointStatus::kSaturated:
      return "saturated";
    case JointStatus::kNotReferenced:
      return "not referenced";
    case JointStatus::kFault:
      return "fault";
  }
  return "unknown";
}

const char* name(ControlMode value) noexcept {
  switch (value) {
    case ControlMode::kDisabled:
      return "disabled";
    case ControlMode::kDamping:
      return "damping";
    case ControlMode::kPosition:
      return "position";
    case ControlMode::kCompliance:
      return "compliance";
    case ControlMode::kJoint:
      return "joint";
  }
  return "unknown";
}

const char* name(LegPhase value) noexcept {
  switch (value) {
    case LegPhase::kIdle:
      return "idle";
    case LegPhase::kStand:
      return "stand";
    case LegPhase::kCrouch:
      return "crouch";
    case LegPhase::kThrust:
      return "thrust";
    case LegPhase::kFlight:
      return "flight";
    case LegPhase::kLanding:
      return "landing";
    case LegPhase::kRecover:
      return "recover";
    case LegPhase::kSwing:
      return "swing";
    case LegPhase::kPreStance:
      return "pre stance";
    case LegPhase::kStance:
      return "stance";
  }
  return "unknown";
}

const char* name(MotionPhase value) noexcept {
  switch (value) {
    case MotionPhase::kIdle:
      return "idle";
    case MotionPhase::kRising:
      return "rising";
    case MotionPhase::kStanding:
      return "standing";
    case MotionPhase::kCrouch:
      return "crouch";
    case MotionPhase::kThrust:
      return "thrust";
    case MotionPhase::kFlight:
      return "flight";
    case MotionPhase::kLanding:
      return "landing";
    case MotionPhase::kRecover:
      return "recover";
    case MotionPhase::kSitting:
      return "sitting";
    case MotionPhase::kMovingJoint:
      return "moving joint";
    case MotionPhase::kComplying:
      return "complying";
    case MotionPhase::kWalking:
      return "walking";
    case MotionPhase::kFallen:
      return "fallen";
  }
  return "unknown";
}

const char* name(LegEvent value) noexcept {
  switch (value) {
    case LegEvent::kNone:
      return "none";
    case LegEvent::kEarlyContact:
      return "early contact";
    case LegEvent::kLateContact:
      return "late contact";
    case LegEvent::kNoGround:
      return "no ground";
    case LegEvent::kSlip:
      return "slip";
    case LegEvent::kStumble:
      return "stumble";
  }
  return "unknown";
}

const char* name(GaitControl value) noexcept {
  switch (value) {
    case GaitControl::kForce:
      return "force";
    case GaitControl::kHybrid:
      return "hybrid";
    case GaitControl::kPreStance:
      return "prestance";
    case GaitControl::kOwn:
      return "own";
  }
  return "unknown";
}

const char* name(JumpMode value) noexcept {
  switch (value) {
    case JumpMode::kPosition:
      return "position";
    case JumpMode::kTorque:
      return "torque";
    case JumpMode::kHybrid:
      return "hybrid";
    case JumpMode::kOwn:
      return "own";
  }
  return "unknown";
}

const char* name(OperatorKind value) noexcept {
  switch (value) {
    case OperatorKind::kNone:
      return "none";
    case OperatorKind::kStand:
      return "stand";
    case OperatorKind::kJump:
      return "jump";
    case OperatorKind::kStop:
      return "stop";
    case OperatorKind::kEstop:
      return "estop";
    case OperatorKind::kClear:
      return "clear";
    case OperatorKind::kSit:
      return "sit";
    case OperatorKind::kHome:
      return "home";
    case OperatorKind::kMoveJoint:
      return "move joint";
    case OperatorKind::kComply:
      return "comply";
    case OperatorKind::kLand:
      return "land";
    case OperatorKind::kWalk:
      return "walk";
  }
  return "unknown";
}

const char* name(OperatorOutcome value) noexcept {
  switch (value) {
    case OperatorOutcome::kAccepted:
      return "accepted";
    case OperatorOutcome::kRefused:
      return "refused";
    case OperatorOutcome::kDone:
      return "done";
    case OperatorOutcome::kFailed:
      return "failed";
    case OperatorOutcome::kQueued:
      return "queued";
  }
  return "unknown";
}

const char* name(ProcessState value) noexcept {
  switch (value) {
    case ProcessState::kStarting:
      return "starting";
    case ProcessState::kReady:
      return "ready";
    case ProcessState::kRunning:
      return "running";
    case ProcessState::kStopping:
      return "stopping";
  }
  return "unknown";
}

const char* name(FaultKind value) noexcept {
  switch (value) {
    case FaultKind::kNone:
      return "none";
    case FaultKind::kOverCurrent:
      return "over-current";
    case FaultKind::kUnderVoltage:
      return "under-voltage";
    case FaultKind::kOverTemperature:
      return "over-temperature";
    case FaultKind::kEncoderStuck:
      return "encoder-stuck";
    case FaultKind::kEncoderJump:
      return "encoder-jump";
    case FaultKind::kEncoderNoise:
      return "encoder-noise";
    case FaultKind::kCurrentOffset:
      return "current-offset";
    case FaultKind::kFramesLost:
      return "frames-lost";
    case FaultKind::kFramesLate:
      return "frames-late";
    case FaultKind::kFramesDuplicated:
      return "frames-duplicated";
    case FaultKind::kFramesFlipped:
      return "frames-flipped";
    case FaultKind::kHeartbeatStopped:
      return "heartbeat-stopped";
    case FaultKind::kBusOff:
      return "bus-off";
    case FaultKind::kErrorPassive:
      return "error-passive";
    case FaultKind::kPowerCycle:
      return "power-cycle";
    case FaultKind::kDuplicateNode:
      return "duplicate-node";
    case FaultKind::kShortPdo:
      return "short-pdo";
    case FaultKind::kLinkDown:
      return "link-down";
    case FaultKind::kQueueFull:
      return "queue-full";
  }
  return "unknown";
}

const char* name(BusCondition value) noexcept {
  switch (value) {
    case BusCondition::kActive:
      return "active";
    case BusCondition::kWarning:
      return "warning";
    case BusCondition::kPassive:
      return "error passive";
    case BusCondition::kNoBuffers:
      return "queue full";
    case BusCondition::kLinkDown:
      return "link down";
    case BusCondition::kOff:
      return "bus off";
  }
  return "unknown";
}

const char* name(ReferenceSource value) noexcept {
  switch (value) {
    case ReferenceSource::kConfigured:
      return "configured";
    case ReferenceSource::kLink:
      return "link";
    case ReferenceSource::kIndex:
      return "index";
    case ReferenceSource::kJig:
      return "jig";
  }
  return "unknown";
}

}  // namespace sprung
