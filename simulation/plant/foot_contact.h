#pragma once
/// Where the ground pushes a foot, and what MuJoCo does with its own warnings.
namespace sprung::sim {

/// Lets contact of a sphere with a plane act at the sphere's lowest point. MuJoCo's own is half-way into the
/// ground: with the soft ground of facts C2 (60 mm at 500 N) that is 30 mm up the shank, a lever for friction
/// that no real foot has. Also keeps MuJoCo from writing MUJOCO_LOG.TXT; warnings are read from mjData. For
/// the whole process, any number of calls from any thread.
void use_foot_contact();

}  // namespace sprung::sim
