#pragma once
/// Which causes in SAFETY_STATE are right for what went wrong. Pure.
#include "signals/modes.h"
#include "tools/lab/campaign/injection.h"

namespace sprung::campaign {

/// @param cause SafetyCause::kNone: the robot went on. That is right only for what is too small or too short
/// to be told from a healthy robot, or shows nowhere.
/// @param powered any drive had power after it. Nobody misses the planner of a robot without.
bool cause_is_expected(const Injection& injection, SafetyCause cause, bool powered) noexcept;

}  // namespace sprung::campaign
