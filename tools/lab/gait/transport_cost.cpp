#include "tools/lab/gait/transport_cost.h"

#include <algorithm>

#include "model/leg_kinematics.h"

namespace sprung {

TransportCost::TransportCost(const RobotConfig& robot, const SimOptions& sim)
    : windings_(motor_windings(robot, sim)),
      known_(windings_.size() == robot.actuators.size() &&
             std::all_of(windings_.begin(), windings_.end(), [](const auto& one) { return one.joint >= 0; })),
      base_W_(kComputer_W + kDrive_W * static_cast<double>(robot.actuators.size())) {
  double mass_kg = robot.body.mass_kg;
  for (const LegConfig& leg : robot.legs)
    for (const LinkConfig& link : leg.links) mass_kg += link.mass_kg;
  weight_N_ = mass_kg * kGravity_m_s2;
}

void TransportCost::add(const SimTruth& truth) {
  double motors_W = 0.0;
  for (const MotorWinding& one : windings_) {
    if (one.joint < 0) continue;
    const TrueJoint& joint = truth.joints[static_cast<std::size_t>(one.joint)];
    motors_W += one.power_W(joint.true_motor_torque_Nm, joint.true_velocity_rad_s);
  }
  sum_W_ += base_W_ + (motors_W < 0.0 ? 0.0 : motors_W);  // what is not known stays so
  ++cycles_;
}

double TransportCost::mean_W() const noexcept { return known_ && cycles_ > 0 ? sum_W_ / cycles_ : kNaN; }

double TransportCost::at(double speed_m_s) const noexcept { return mean_W() / (weight_N_ * speed_m_s); }

}  // namespace sprung
