#include "planner/gait/body_view.h"

#include <algorithm>
#include <stdexcept>

#include "model/leg_kinematics.h"

namespace sprung {
namespace {

constexpr double kCarries = 0.05;  // of the weight

template <class Values>
bool known(const Values& values) noexcept {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace

BodyShape::BodyShape(const RobotConfig& robot)
    : legs(robot.legs.size()), mass_kg(robot.body.mass_kg), body_(robot.body) {
  if (legs > kMostLegs) throw std::invalid_argument("a walk knows at most 4 legs");
  for (std::size_t i = 0; i < legs; ++i) {
    const LegConfig& leg = robot.legs[i];
    joints[i] = leg.joints;
    hip_in_trunk_m[i] = to_eigen(leg.hip_in_trunk_m);
    foot_radius_m[i] = leg.foot_radius_m;
    side[i] = leg.hip_in_trunk_m[1] >= 0.0 ? 1.0 : -1.0;
    const bool sideways = leg.kinematics == kThreeJoint;
    foot_beside_hip_m[i].setZero();
    if (sideways)
      foot_beside_hip_m[i].y() = (leg.side == LegSide::kLeft ? 1.0 : -1.0) * leg.links[0].length_m;
    for (std::size_t k = 0; k < leg.links.size(); ++k)
      (sideways && k == 0 ? hip_mass_kg_ : leg_mass_kg_)[i] += leg.links[k].mass_kg;
    mass_kg += hip_mass_kg_[i] + leg_mass_kg_[i];
  }
}

/// Thigh and shank count at the middle between hip and foot, which is 10 mm right where they are heaviest
/// near the hip.
Eigen::Vector3d BodyShape::com_in_trunk_m(const JointState& in) const noexcept {
  Eigen::Vector3d moment = body_.mass_kg * to_eigen(body_.com_in_trunk_m);
  for (std::size_t i = 0; i < legs; ++i) {
    const Eigen::Vector3d foot_m = to_eigen(in.legs[i].estimated_foot_in_hip_m);
    const Eigen::Vector3d middle_m = foot_m.allFinite() ? Eigen::Vector3d(0.5 * foot_m)
                                                        : foot_beside_hip_m[i];
    moment += hip_mass_kg_[i] * (hip_in_trunk_m[i] + foot_beside_hip_m[i]) +
              leg_mass_kg_[i] * (hip_in_trunk_m[i] + middle_m);
  }
  Eigen::Vector3d com_m = moment / (mass_kg - load_.mass_kg);
  com_m.head<2>() += load_.com_shift_m;
  return com_m;
}

void BodyShape::carry(const LoadOnTrunk& load) noexcept {
  mass_kg += load.mass_kg - load_.mass_kg;
  load_ = load;
}

BodyView BodyView::of(const JointState& in, const BodyShape& shape) noexcept {
  BodyView out;
  const EstimatedBody& body = in.body;
  if (known(body.estimated_quaternion_wxyz)) out.attitude = sprung::attitude(body.estimated_quaternion_wxyz);
  out.level_from_trunk = sprung::level_from_trunk(out.attitude);
  if (known(body.estimated_angular_velocity_rad_s))
    out.angular_velocity_rad_s = out.level_from_trunk * to_eigen(body.estimated_angular_velocity_rad_s);
  out.velocity_known = known(body.estimated_velocity_m_s);
  if (out.velocity_known) out.velocity_m_s = out.level_from_trunk * to_eigen(body.estimated_velocity_m_s);
  out.com_m = out.level_from_trunk * shape.com_in_trunk_m(in);
  for (std::size_t i = 0; i < shape.legs; ++i) {
    const EstimatedLeg& leg = in.legs[i];
    out.foot_m[i] = out.level_from_trunk * (shape.hip_in_trunk_m[i] + to_eigen(leg.estimated_foot_in_hip_m));
    const double up_N = (out.level_from_trunk * to_eigen(leg.foot_force_N)).z();
    out.carries[i] = leg.contact || !(up_N <= kCarries * shape.mass_kg * kGravity_m_s2);
  }
  out.uses_imu = body.uses_imu;
  return out;
}

}  // namespace sprung
