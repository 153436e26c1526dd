#include "tools/lab/campaign/expected_cause.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace sprung::campaign {
namespace {

bool any_of(SafetyCause cause, std::initializer_list<SafetyCause> allowed) noexcept {
  return std::find(allowed.begin(), allowed.end(), cause) != allowed.end();
}

/// Whether a fault of this kind shows on the bus however short or small it was drawn.
bool must_be_named(const Injection& one) noexcept {
  constexpr double kPlain_s = 0.15;    // longer than the slowest watch, the drives' heartbeats
  constexpr double kPlain_rad = 0.1;   // nothing turns so far in a cycle
  constexpr double kPlainShare = 0.9;  // of frames: more in a row than silent_cycles
  switch (one.drive_fault) {
    case FaultKind::kEncoderJump:
      return std::abs(one.value) >= kPlain_rad;
    case FaultKind::kFramesLost:
      return one.value >= kPlainShare && one.duration_s >= kPlain_s;
    case FaultKind::kShortPdo:
    case FaultKind::kHeartbeatStopped:
    case FaultKind::kDuplicateNode:
    case FaultKind::kQueueFull:
      return one.duration_s >= kPlain_s;
    case FaultKind::kOverCurrent:
    case FaultKind::kUnderVoltage:
    case FaultKind::kOverTemperature:
    case FaultKind::kPowerCycle:
    case FaultKind::kBusOff:
    case FaultKind::kErrorPassive:
    case FaultKind::kLinkDown:
      return true;
    default:
      return false;
  }
}

bool drive_cause(const Injection& one, SafetyCause cause) noexcept {
  using C = SafetyCause;
  if (cause == C::kNone) return !must_be_named(one);
  switch (one.drive_fault) {
    case FaultKind::kOverCurrent:
    case FaultKind::kUnderVoltage:
    case FaultKind::kOverTemperature:
      return cause == C::kDriveFault;
    case FaultKind::kEncoderStuck:
    case FaultKind::kEncoderJump:
    case FaultKind::kEncoderNoise:
      return any_of(cause, {C::kImplausible, C::kJointLimit, C::kOverspeed, C::kDriveFault});
    case FaultKind::kHeartbeatStopped:
    case FaultKind::kFramesLost:
    case FaultKind::kShortPdo:
      return cause == C::kDriveSilent;
    case FaultKind::kFramesLate:
    case FaultKind::kFramesDuplicated:
      // A sample of another cycle than it is taken for looks like a jump where the joint is fast.
      return any_of(cause, {C::kDriveSilent, C::kDuplicateNode, C::kImplausible});
    case FaultKind::kFramesFlipped:
      return any_of(cause, {C::kImplausible, C::kDriveFault, C::kDriveSilent, C::kDuplicateNode});
    case FaultKind::kPowerCycle:
      return any_of(cause, {C::kDriveSilent, C::kDriveFault});
    case FaultKind::kDuplicateNode:
      return cause == C::kDuplicateNode;
    case FaultKind::kBusOff:
    case FaultKind::kErrorPassive:
    case FaultKind::kLinkDown:
    case FaultKind::kQueueFull:
      return cause == C::kBusLost;
    default:
      return false;
  }
}

bool process_cause(const Injection& one, SafetyCause cause, bool powered) noexcept {
  using C = SafetyCause;
  // A bridge that is gone names nothing; that the drives let go is the judge's to see.
  const bool killed = one.process_fault == ProcessFault::kKilled && one.process != StackProcess::kBridge;
  const bool missed = one.process != StackProcess::kPlanner || powered;
  if (cause == C::kNone) return !(killed && missed);
  switch (one.process) {
    case StackProcess::kBridge:
      return any_of(cause, {C::kDriveFault, C::kDriveSilent});
    case StackProcess::kPlanner:
      return cause == C::kPlannerLost;
    default:
      return cause == C::kCommandStale;
  }
}

bool foreign_cause(const Injection& one, SafetyCause cause) noexcept {
  using C = SafetyCause;
  if (one.foreign == Foreign::kHeartbeat) return cause == C::kNone;
  return any_of(cause, {C::kForeignMaster, C::kDriveSilent, C::kDriveFault});
}

}  // namespace

bool cause_is_expected(const Injection& injection, SafetyCause cause, bool powered) noexcept {
  using C = SafetyCause;
  switch (injection.kind) {
    case Class::kNone:
      return cause == C::kNone;
    case Class::kDrive:
    case Class::kBus:
      return drive_cause(injection, cause);
    case Class::kMessage:
      return any_of(cause, {C::kNone, C::kCommandStale, C::kCommandRefused, C::kPlannerLost});
    case Class::kField:
      return any_of(cause, {C::kNone, C::kCommandStale, C::kCommandRefused, C::kPlannerLost, C::kJointLimit,
                            C::kOverspeed});
    case Class::kProcess:
      return process_cause(injection, cause, powered);
    case Class::kForeign:
      return foreign_cause(injection, cause);
    case Class::kFile:
      return any_of(cause, {C::kNone, C::kJointLimit, C::kOverspeed, C::kImplausible, C::kDriveFault});
  }
  return false;
}

}  // namespace sprung::campaign
