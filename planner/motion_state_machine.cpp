#include "planner/motion_state_machine.h"

#include <algorithm>

namespace sprung {
namespace {

using E = MotionEvent;
using P = MotionPhase;

const MotionTable kTransitions{{
    {P::kIdle, E::kStandRequested, P::kRising, "stand requested"},
    {P::kRising, E::kEnableTimeout, P::kIdle, "drives were not enabled within the time-out"},
    {P::kRising, E::kRisen, P::kStanding, "stand reached"},
    {P::kStanding, E::kJumpRequested, P::kCrouch, "jump requested"},
    {P::kCrouch, E::kCrouched, P::kThrust, "crouched and settled"},
    {P::kCrouch, E::kStopped, P::kRecover, "stopped by the operator before the thrust"},
    {P::kThrust, E::kLiftOff, P::kFlight, "lift-off: contact lost"},
    {P::kThrust, E::kRetracting, P::kFlight, "lift-off: the leg is drawn in again"},
    {P::kThrust, E::kThrustTimeout, P::kLanding, "thrust time-out: no lift-off measured"},
    {P::kFlight, E::kTouchdown, P::kLanding, "touchdown: contact"},
    {P::kFlight, E::kFlightTimeout, P::kLanding, "flight time-out: no touchdown measured"},
    {P::kLanding, E::kLandingHeld, P::kRecover, "landing held"},
    {P::kRecover, E::kRecovered, P::kStanding, "stand reached again"},
    {P::kRecover, E::kNextJump, P::kCrouch, "next jump"},
    {P::kStanding, E::kSitRequested, P::kSitting, "sit requested"},
    {P::kRising, E::kLetGo, P::kSitting, "nobody holds: damped, then off"},
    {P::kSitting, E::kSat, P::kIdle, "sat down, drives off"},
    {P::kIdle, E::kJointRequested, P::kMovingJoint, "joint move requested"},
    {P::kMovingJoint, E::kJointRequested, P::kMovingJoint, "further joint move requested"},
    {P::kMovingJoint, E::kEnableTimeout, P::kIdle, "drives were not enabled within the time-out"},
    {P::kMovingJoint, E::kJointArrived, P::kMovingJoint, "joint move ended, joints held"},
    {P::kMovingJoint, E::kJointStopped, P::kMovingJoint, "joint move stopped by the operator, joints held"},
    {P::kMovingJoint, E::kSitRequested, P::kSitting, "joints let go: damped, then off"},
    {P::kStanding, E::kComplyRequested, P::kComplying, "compliance requested"},
    {P::kComplying, E::kComplyRequested, P::kComplying, "other compliance requested"},
    {P::kComplying, E::kStopped, P::kRecover, "compliance stopped by the operator"},
    {P::kComplying, E::kSitRequested, P::kSitting, "sit requested"},
    {P::kStanding, E::kLandRequested, P::kFlight, "a fall is to be caught"},
    {P::kStanding, E::kWalkRequested, P::kWalking, "walk requested"},
    {P::kWalking, E::kWalkRequested, P::kWalking, "other gait or speed requested"},
    {P::kWalking, E::kWalkEnded, P::kRecover, "walk ended, all feet stand"},
    {P::kFallen, E::kSat, P::kIdle, "fell: damped, then off"},
    {std::nullopt, E::kFell, P::kFallen, "a fall was detected: legs are damped"},
    {std::nullopt, E::kSafetyLost, P::kIdle, "stopped by safety"},
    {std::nullopt, E::kDriveLost, P::kIdle, "a drive is in fault or no longer enabled"},
    {std::nullopt, E::kFootLost, P::kIdle, "a measured foot position is missing where a move begins"},
    {std::nullopt, E::kRestarted, P::kIdle, "cycle count went back: the bridge was restarted"},
}};

}  // namespace

const MotionTable& motion_transitions() noexcept { return kTransitions; }

const MotionTransition* MotionStateMachine::process_event(MotionEvent event) noexcept {
  const auto* row = std::find_if(kTransitions.begin(), kTransitions.end(), [&](const MotionTransition& t) {
    const bool from_here = t.from ? *t.from == state_ : state_ != MotionPhase::kIdle;
    return from_here && t.event == event;
  });
  if (row == kTransitions.end()) return nullptr;
  state_ = row->to;
  last_ = row;
  return row;
}

}  // namespace sprung
