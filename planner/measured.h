#pragma once
/// Questions that a motion asks of JOINT_STATE. Pure.
#include "signals/joint_state.h"
#include "signals/vec3.h"

namespace sprung {

bool all_enabled(const JointState& in) noexcept;
/// No joint's estimate still settles.
bool all_settled(const JointState& in) noexcept;
bool any_fault(const JointState& in) noexcept;
bool any_contact(const JointState& in) noexcept;
/// Hip to foot, downward, m: the longest of all legs.
double longest_leg_m(const JointState& in) noexcept;

}  // namespace sprung
