#include "simulation/plant/presliding.h"

#include <algorithm>
#include <cmath>

namespace sprung::sim {
namespace {

/// Where each spring, with a quarter of the torque, begins to slide, as shares of the whole way [design
/// choice]: steep first, flat at the end, as measured curves are.
constexpr double kSlidesAt[] = {0.1, 0.25, 0.5, 1.0};
/// Of the critical damping of mass and springs [design choice]: so small that it takes about 1 Nm where a
/// jump breaks a joint loose, and rest comes within a tenth of a second.
constexpr double kDampingRatio = 0.05;

}  // namespace

Presliding::Presliding(double full_Nm, double way_rad, double mass_kg_m2) noexcept {
  for (std::size_t i = 0; i < kSprings; ++i)
    stiffness_Nm_rad_[i] = full_Nm / kSprings / (kSlidesAt[i] * way_rad);
  damping_Nm_s_rad_ = 2.0 * kDampingRatio * std::sqrt(stiffness_Nm_rad() * mass_kg_m2);
}

void Presliding::reset() noexcept {
  springs_Nm_.fill(0.0);
  slides_.fill(false);
}

double Presliding::stiffness_Nm_rad() const noexcept {
  double sum = 0.0;
  for (const double stiffness : stiffness_Nm_rad_) sum += stiffness;
  return sum;
}

double Presliding::torque_Nm(double speed_rad_s) const noexcept {
  double sum_Nm = 0.0, holding = 0.0;
  for (std::size_t i = 0; i < kSprings; ++i) {
    sum_Nm += springs_Nm_[i];
    if (!slides_[i]) holding += stiffness_Nm_rad_[i];
  }
  const double whole = stiffness_Nm_rad();
  return sum_Nm + (whole > 0.0 ? holding / whole * damping_Nm_s_rad_ * speed_rad_s : 0.0);
}

void Presliding::move(double way_rad, double dry_Nm) noexcept {
  const double most_Nm = dry_Nm / kSprings;
  for (std::size_t i = 0; i < kSprings; ++i) {
    const double held_Nm = springs_Nm_[i] + stiffness_Nm_rad_[i] * way_rad;
    springs_Nm_[i] = std::clamp(held_Nm, -most_Nm, most_Nm);
    slides_[i] = springs_Nm_[i] != held_Nm;
  }
}

}  // namespace sprung::sim
