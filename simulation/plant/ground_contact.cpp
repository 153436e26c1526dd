#include "simulation/plant/ground_contact.h"

#include <algorithm>

#include "simulation/plant/mujoco_row.h"

namespace sprung::sim {
namespace {

/// MuJoCo's collision functions take no word of ours.
thread_local const UnevenFloor* uneven_floor = nullptr;

mjfCollision& plane_sphere() { return mjCOLLISIONFUNC[mjGEOM_PLANE][mjGEOM_SPHERE]; }

mjfCollision mujocos_own() {
  static const mjfCollision own = plane_sphere();
  return own;
}

int contact_at_lowest_point(const mjModel* model, const mjData* data, mjContact* contacts, int plane,
                            int sphere, mjtNum margin) {
  const mjtNum* centre = row(data->geom_xpos, sphere, 3);
  const mjtNum radius = *row(model->geom_size, sphere, 3);
  if (uneven_floor != nullptr && uneven_floor->decides(plane, sphere))
    return uneven_floor->meet(centre, radius, margin, *contacts);
  const int count = mujocos_own()(model, data, contacts, plane, sphere, margin);
  for (int i = 0; i < count; ++i) mju_addScl3(contacts[i].pos, centre, contacts[i].frame, -radius);
  return count;
}

void keep_silent(const char* /*message*/) {}

}  // namespace

void use_foot_contact() {
  // Once, for other threads may already be simulating.
  static const bool used = [] {
    mujocos_own();  // remembered before it is replaced
    plane_sphere() = contact_at_lowest_point;
    mju_user_warning = keep_silent;
    return true;
  }();
  (void)used;
}

UnevenFloor::UnevenFloor(const Ground& ground, int floor, const std::vector<int>& feet) noexcept
    : ground_(ground), floor_(floor), feet_(feet) {
  if (ground.uneven()) uneven_floor = this;
}

UnevenFloor::~UnevenFloor() {
  if (uneven_floor == this) uneven_floor = nullptr;
}

bool UnevenFloor::decides(int plane, int sphere) const noexcept {
  return plane == floor_ && std::find(feet_.begin(), feet_.end(), sphere) == feet_.end();
}

int UnevenFloor::meet(const mjtNum centre[3], mjtNum radius, mjtNum margin,
                      mjContact& contact) const noexcept {
  const Ground::Place place = ground_.below(centre[0], centre[1]);
  const double over_m = place.distance_m({centre[0], centre[1], centre[2]}) - radius;
  if (over_m > margin) return 0;
  contact.dist = over_m;
  std::copy(place.normal.begin(), place.normal.end(), contact.frame);
  mju_zero3(contact.frame + 3);  // MuJoCo makes the tangents
  mju_addScl3(contact.pos, centre, contact.frame, -radius);
  return 1;
}

void set_friction(mjModel& model, int sphere, double friction) noexcept {
  row(model.geom_friction, sphere, 3)[0] = friction;
  for (int pair = 0; pair < model.npair; ++pair) {
    if (model.pair_geom1[pair] != sphere && model.pair_geom2[pair] != sphere) continue;
    mjtNum* both = row(model.pair_friction, pair, 5);
    both[0] = both[1] = friction;
  }
}

}  // namespace sprung::sim
