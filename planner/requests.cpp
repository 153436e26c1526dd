#include "planner/requests.h"

#include <algorithm>

#include "planner/measured.h"

namespace sprung {
namespace {

constexpr const char* kNotOperational = "safety is not operational: clear it first";
constexpr const char* kNotReady = "a joint is not ready: see its status";
constexpr const char* kNotReferenced = "a joint is not referenced: sprung home";
constexpr const char* kUnknownMode = "jump mode must be position, torque, hybrid or adaptive";

bool usable(const EstimatedJoint& joint) noexcept {
  return joint.status == JointStatus::kOk || joint.status == JointStatus::kSaturated ||
         joint.status == JointStatus::kStarting;
}

bool not_referenced(const EstimatedJoint& joint) noexcept {
  return joint.status == JointStatus::kNotReferenced;
}

}  // namespace

bool known(JumpMode mode) noexcept {
  return mode == JumpMode::kPosition || mode == JumpMode::kTorque || mode == JumpMode::kHybrid ||
         mode == JumpMode::kAdaptive;
}

const char* busy(MotionPhase state) noexcept {
  switch (state) {
    case MotionPhase::kStanding:
      return "busy: standing, sit first";
    case MotionPhase::kMovingJoint:
      return "busy: single joints are held, sit first";
    case MotionPhase::kRising:
      return "busy: rising";
    case MotionPhase::kSitting:
      return "busy: sitting down";
    case MotionPhase::kIdle:
      return "not standing: stand first";
    case MotionPhase::kComplying:
      return "busy: complying, stop first";
    case MotionPhase::kWalking:
      return "busy: walking, stop first";
    case MotionPhase::kFallen:
      return "busy: fallen, legs are let down";
    case MotionPhase::kCrouch:
    case MotionPhase::kThrust:
    case MotionPhase::kFlight:
    case MotionPhase::kLanding:
    case MotionPhase::kRecover:
      break;
  }
  return "busy: jumping";
}

const char* why_not_risen(const JointState& in) noexcept {
  if (in.safety != SafetyLevel::kOperational) return kNotOperational;
  if (std::any_of(in.joints.begin(), in.joints.end(), not_referenced)) return kNotReferenced;
  const bool ready = std::all_of(in.joints.begin(), in.joints.end(), usable) &&
                     std::all_of(in.legs.begin(), in.legs.end(),
                                 [](const EstimatedLeg& l) { return finite(l.estimated_foot_in_hip_m); });
  return ready ? nullptr : kNotReady;
}

const char* why_not_held(const JointState& in) noexcept {
  if (in.safety != SafetyLevel::kOperational) return kNotOperational;
  for (const EstimatedJoint& joint : in.joints) {
    if (not_referenced(joint)) return kNotReferenced;
    if (!usable(joint)) return kNotReady;
  }
  return nullptr;
}

const char* validate_jump(const OperatorCommand& command) noexcept {
  if (!known(command.jump_mode)) return kUnknownMode;
  if (command.jump_count < 1 || command.jump_count > kMostJumps) return "jump count must be 1 to 100";
  return nullptr;
}

const char* validate_land(const OperatorCommand& command) noexcept {
  if (!known(command.jump_mode)) return kUnknownMode;
  const double fall_s = command.touchdown_in_s;
  const bool possible = fall_s >= kShortestFall_s && fall_s <= kLongestFall_s;
  return possible ? nullptr : "touchdown must be expected in 0.02 to 1 s";
}

}  // namespace sprung
