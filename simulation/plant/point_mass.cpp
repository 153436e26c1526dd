#include "simulation/plant/point_mass.h"

#include "simulation/plant/mujoco_row.h"

namespace sprung::sim {
namespace {

/// Adds m (|d|^2 1 - d d^T): a mass at the distance d from the point that `inertia` is about.
void add_steiner(mjtNum inertia[9], double mass_kg, const mjtNum d[3]) noexcept {
  const mjtNum square = mju_dot3(d, d);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) inertia[3 * i + j] += mass_kg * ((i == j ? square : 0.0) - d[i] * d[j]);
  }
}

/// In the body's axes, about its centre of mass.
void body_inertia(const mjModel& model, int body, mjtNum out[9]) noexcept {
  mjtNum turn[9], scaled[9];
  mju_quat2Mat(turn, row(model.body_iquat, body, 4));
  const mjtNum* principal = row(model.body_inertia, body, 3);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) scaled[3 * i + j] = turn[3 * i + j] * principal[j];
  }
  mju_mulMatMatT(out, scaled, turn, 3, 3, 3);
}

}  // namespace

void add_point_mass(mjModel& model, int body, const mjtNum place[3], double mass_kg) noexcept {
  mjtNum* centre = row(model.body_ipos, body, 3);
  const double before_kg = model.body_mass[body], together_kg = before_kg + mass_kg;
  mjtNum inertia[9], to_weight[3], to_body[3], vectors[9], principal[3];
  body_inertia(model, body, inertia);
  mju_sub3(to_weight, place, centre);
  mju_scl3(to_body, to_weight, -mass_kg / together_kg);  // from the common centre
  add_steiner(inertia, before_kg, to_body);
  mju_addToScl3(centre, to_weight, mass_kg / together_kg);
  mju_sub3(to_weight, place, centre);
  add_steiner(inertia, mass_kg, to_weight);
  mju_eig3(principal, vectors, row(model.body_iquat, body, 4), inertia);
  mju_copy3(row(model.body_inertia, body, 3), principal);
  model.body_mass[body] = together_kg;
  model.body_sameframe[body] = 0;
}

}  // namespace sprung::sim
