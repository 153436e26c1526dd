#pragma once
/// Which causes in SAFETY_STATE are right for what went wrong. Pure.
#include "signals/modes.h"
#include "tools/lab/campaign/injection.h"

namespace sprung::campaign {

/// @param cause SafetyCause::kNone: the robot went on. That is right only for what is too small or too short
/// to be told from a healthy robot, or shows nowhere.
bool cause_is_expected(const Injection& injection, SafetyCause cause) noexcept;

}  // namespace sprung::campaign
