#include "simulation/plant/foot_contact.h"

#include <mujoco/mujoco.h>

#include <mutex>

#include "simulation/plant/mujoco_row.h"

namespace sprung::sim {
namespace {

mjfCollision& plane_sphere() { return mjCOLLISIONFUNC[mjGEOM_PLANE][mjGEOM_SPHERE]; }

mjfCollision mujocos_own() {
  static const mjfCollision own = plane_sphere();
  return own;
}

int contact_at_lowest_point(const mjModel* model, const mjData* data, mjContact* contacts, int plane,
                            int sphere, mjtNum margin) {
  const int count = mujocos_own()(model, data, contacts, plane, sphere, margin);
  for (int i = 0; i < count; ++i) {
    const mjtNum* normal = contacts[i].frame;
    mju_addScl3(contacts[i].pos, row(data->geom_xpos, sphere, 3), normal, -*row(model->geom_size, sphere, 3));
  }
  return count;
}

void keep_silent(const char* /*message*/) {}

}  // namespace

void use_foot_contact() {
  static std::once_flag once;  // other threads may already be simulating
  std::call_once(once, [] {
    mujocos_own();  // remembered before it is replaced
    plane_sphere() = contact_at_lowest_point;
    mju_user_warning = keep_silent;
  });
}

}  // namespace sprung::sim
