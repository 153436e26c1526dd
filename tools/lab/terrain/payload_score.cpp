#include "tools/lab/terrain/payload_score.h"

#include <cmath>

#include "model/leg_kinematics.h"
#include "signals/vec3.h"

namespace sprung {

void PayloadScore::add(InProcessRobot& robot) {
  const SimTruth& truth = robot.truth();
  cycles_ += 1.0;
  for (const TrueLeg& leg : truth.legs) force_N_ += leg.true_contact_force_N[2];
  const std::array<double, 4>& q = truth.base_quaternion_wxyz;
  const Eigen::Quaterniond trunk_to_world(q[0], q[1], q[2], q[3]);
  const Eigen::Vector3d com_in_trunk_m = trunk_to_world.conjugate() *
                                         (to_eigen(truth.com_in_world_m) - to_eigen(truth.base_in_world_m));
  const Eigen::Vector2d without_load_m = shape_.com_in_trunk_m(robot.joint_state()).head<2>();
  com_m_ += without_load_m;
  shift_m_ += com_in_trunk_m.head<2>() - without_load_m;
}

double PayloadScore::mass_kg() const { return force_N_ / (cycles_ * kGravity_m_s2); }

double PayloadScore::mass_off_kg(const EstimatedPayload& said) const {
  return std::abs(said.mass_kg - (mass_kg() - shape_.mass_kg));
}

double PayloadScore::com_off_m(const EstimatedPayload& said) const {
  const double share = said.mass_kg / (shape_.mass_kg + said.mass_kg);
  const Eigen::Vector2d said_m(said.in_trunk_m[0], said.in_trunk_m[1]);
  const Eigen::Vector2d shift_m = share * (said_m - com_m_ / cycles_);
  return (shift_m - shift_m_ / cycles_).norm();
}

}  // namespace sprung
