#include "controller/one_link.h"

#include <cmath>
#include <stdexcept>

namespace sprung {
namespace {

constexpr double kTwoPi = 6.283185307179586;
constexpr double kNearCircle_m = 1e-3;

void require(bool ok, const LegConfig& leg, const char* what) {
  if (!ok) throw std::invalid_argument("leg '" + leg.name + "': one_link needs " + what);
}

JointVector single(double value) noexcept {
  JointVector v(1);
  v << value;
  return v;
}

}  // namespace

OneLink::OneLink(const LegConfig& leg) {
  require(leg.joints.size() == 1, leg, "one joint");
  require(leg.links.size() == 1, leg, "one link");
  arm_ = leg.links[0];
  require(arm_.length_m > 0.0, leg, "a link of positive length");
}

Eigen::Vector3d OneLink::foot_in_hip_m(const JointVector& position_rad) const noexcept {
  return {arm_.length_m * std::sin(position_rad[0]), 0.0, -arm_.length_m * std::cos(position_rad[0])};
}

LegJacobian OneLink::jacobian(const JointVector& position_rad) const noexcept {
  LegJacobian j(3, 1);
  j << arm_.length_m * std::cos(position_rad[0]), 0.0, arm_.length_m * std::sin(position_rad[0]);
  return j;
}

InverseResult OneLink::inverse(const Eigen::Vector3d& foot_in_hip_m,
                               const JointVector& near_rad) const noexcept {
  const double toward_rad = std::atan2(foot_in_hip_m.x(), -foot_in_hip_m.z());
  const double turns = std::round((near_rad[0] - toward_rad) / kTwoPi);
  InverseResult out;
  out.position_rad = single(toward_rad + kTwoPi * turns);
  out.reachable = (foot_in_hip_m - this->foot_in_hip_m(out.position_rad)).norm() <= kNearCircle_m;
  return out;
}

JointVector OneLink::gravity_torque_Nm(const JointVector& position_rad) const noexcept {
  return single(arm_.mass_kg * kGravity_m_s2 * arm_.com_m * std::sin(position_rad[0]));
}

JointVector OneLink::inverse_dynamics_Nm(const JointVector& position_rad,
                                         const JointVector& /*velocity_rad_s*/,
                                         const JointVector& acceleration_rad_s2) const noexcept {
  const double inertia_kg_m2 = arm_.inertia_kg_m2 + arm_.mass_kg * arm_.com_m * arm_.com_m;
  return single(inertia_kg_m2 * acceleration_rad_s2[0]) + gravity_torque_Nm(position_rad);
}

}  // namespace sprung
