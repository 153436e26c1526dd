#pragma once
/// A point mass clamped to a body: the known weight that `sprung identify` hangs at a foot, or a payload on
/// the trunk. Start-up only.
#include <mujoco/mujoco.h>

namespace sprung::sim {

/// Mass, centre and inertia of `body` become those of body and weight together; mj_setConst() must follow.
/// @param place in the body's own axes, m.
void add_point_mass(mjModel& model, int body, const mjtNum place[3], double mass_kg) noexcept;

}  // namespace sprung::sim
