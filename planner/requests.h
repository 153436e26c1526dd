#pragma once
/// Why an operator's command cannot be done now: static texts for people; nullptr where it can. Pure.
#include "signals/joint_state.h"
#include "signals/operator.h"

namespace sprung {

inline constexpr int kMostJumps = 100;
inline constexpr double kShortestFall_s = 0.02;
inline constexpr double kLongestFall_s = 1.0;  ///< 4.9 m

bool known(JumpMode mode) noexcept;
/// What keeps this state from another command.
const char* busy(MotionPhase state) noexcept;
/// An estimator that still settles is fine: every motion waits for it.
const char* why_not_risen(const JointState& in) noexcept;
/// Every joint can be held where it is?
const char* why_not_held(const JointState& in) noexcept;
/// Mode and count; the curve has its own limits.
const char* validate_jump(const OperatorCommand& command) noexcept;
const char* validate_land(const OperatorCommand& command) noexcept;

}  // namespace sprung
