#include "simulation/plant/elastic_gear.h"

#include <algorithm>
#include <cmath>

namespace sprung::sim {

ElasticGear::ElasticGear(const TorsionConfig& torsion, double armature_kg_m2) noexcept
    : torsion_(torsion), armature_kg_m2_(armature_kg_m2) {}

void ElasticGear::reset(double link_rad) noexcept {
  position_rad_ = link_rad;
  velocity_rad_s_ = dry_friction_Nm_ = viscous_friction_Nm_ = 0.0;
}

double ElasticGear::output_torque_Nm(double link_rad, double link_rad_s) const noexcept {
  const double free_rad = position_rad_ - link_rad;
  const double strain_rad = std::abs(free_rad) - 0.5 * torsion_.backlash_rad;
  if (torsion_.backlash_rad > 0.0 && strain_rad <= 0.0) return 0.0;
  const double twist_rad = std::copysign(strain_rad, free_rad);
  const double soft_rad = std::min(std::abs(twist_rad), torsion_.second_from_Nm / torsion_.stiffness_Nm_rad);
  const double spring_Nm = torsion_.stiffness_Nm_rad * soft_rad +
                           torsion_.second_stiffness_Nm_rad * (std::abs(twist_rad) - soft_rad);
  const double torque_Nm = std::copysign(spring_Nm, twist_rad) +
                           torsion_.damping_Nm_s_rad * (velocity_rad_s_ - link_rad_s);
  const bool pulls = torque_Nm * twist_rad < 0.0;  // flanks that part do not hold each other
  return torsion_.backlash_rad > 0.0 && pulls ? 0.0 : torque_Nm;
}

void ElasticGear::step(double motor_torque_Nm, double output_torque_Nm, double dry_Nm,
                       double viscous_Nm_s_rad, double dt_s) noexcept {
  const double free_rad_s = velocity_rad_s_ + dt_s / armature_kg_m2_ * (motor_torque_Nm - output_torque_Nm);
  // Solves v = free - dt / J (viscous v + dry sgn v), with any friction up to `dry` at v = 0.
  const double stopped_rad_s = dt_s / armature_kg_m2_ * dry_Nm;
  const double left_rad_s = std::max(0.0, std::abs(free_rad_s) - stopped_rad_s);
  velocity_rad_s_ = std::copysign(left_rad_s, free_rad_s) / (1.0 + dt_s / armature_kg_m2_ * viscous_Nm_s_rad);
  dry_friction_Nm_ = left_rad_s > 0.0 ? std::copysign(dry_Nm, free_rad_s)
                                      : free_rad_s * armature_kg_m2_ / dt_s;
  viscous_friction_Nm_ = viscous_Nm_s_rad * velocity_rad_s_;
  position_rad_ += dt_s * velocity_rad_s_;
}

}  // namespace sprung::sim
