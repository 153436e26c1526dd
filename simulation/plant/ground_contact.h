#pragma once
/// How spheres meet the ground in MuJoCo: at their lowest point, and each the ground that lies below itself.
#include <mujoco/mujoco.h>

#include <vector>

#include "simulation/plant/ground.h"

namespace sprung::sim {

/// Lets contact of a sphere with a plane act at the sphere's lowest point. MuJoCo's own is half-way into the
/// ground: with the soft ground of facts C2 (60 mm at 500 N) that is 30 mm up the shank, a lever for friction
/// that no real foot has. Also keeps MuJoCo from writing MUJOCO_LOG.TXT; warnings are read from mjData. For
/// the whole process, any number of calls from any thread.
void use_foot_contact();

/// While it lives, whatever meets the plane `floor` on this thread, but for feet, meets `ground` below itself
/// instead: a knee the step under it, the trunk's corners a slope each at its place. Feet have planes of
/// their own, which the plant moves.
class UnevenFloor {
 public:
  UnevenFloor(const Ground& ground, int floor, const std::vector<int>& feet) noexcept;
  ~UnevenFloor();
  UnevenFloor(const UnevenFloor&) = delete;
  UnevenFloor& operator=(const UnevenFloor&) = delete;

  bool decides(int plane, int sphere) const noexcept;
  /// As MuJoCo's collision functions do. @return how many contacts: 0 or 1.
  int meet(const mjtNum centre[3], mjtNum radius, mjtNum margin, mjContact& contact) const noexcept;

 private:
  const Ground& ground_;
  int floor_;
  const std::vector<int>& feet_;
};

/// Coulomb's coefficient of a sphere on whatever it meets: in its geom and in the pairs that model.xml lists.
void set_friction(mjModel& model, int sphere, double friction) noexcept;

}  // namespace sprung::sim
