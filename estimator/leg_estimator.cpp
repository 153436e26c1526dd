#include "estimator/leg_estimator.h"

#include <cmath>

namespace sprung {

LegEstimator::LegEstimator(const RobotConfig& robot, const LegConfig& leg, int longest_coast_cycles)
    : joints_(leg.joints),
      sampler_(robot, leg),
      kinematics_(make_leg_kinematics(leg)),
      samples_(leg.joints.size()) {
  if (kinematics_ != nullptr)
    contact_.emplace(
        ContactParams{leg.contact_on_N, leg.contact_off_N, leg.contact_rise_s, leg.contact_fall_s});
  const int n = static_cast<int>(joints_.size());
  for (int j = 0; j < n; ++j) {
    const JointConfig& joint =
        robot.joints.at(static_cast<std::size_t>(joints_[static_cast<std::size_t>(j)]));
    estimators_.emplace_back(joint, robot.cycle_s, sampler_.encoder_step_rad(j), longest_coast_cycles);
  }
  for (JointVector* v : {&position_rad_, &velocity_rad_s_, &acceleration_rad_s2_, &output_torque_Nm_})
    v->resize(n);
}

void LegEstimator::reset() noexcept {
  for (JointEstimator& e : estimators_) e.reset();
  if (contact_) contact_->reset();
}

void LegEstimator::step(const std::vector<ActuatorState>& actuators, double dt_s,
                        std::vector<EstimatedJoint>& joints, EstimatedLeg& out) noexcept {
  sampler_.sample(actuators, samples_);
  step_joints(dt_s, joints);
  out = EstimatedLeg{};
  if (kinematics_ != nullptr) step_foot(dt_s, joints, out);
}

void LegEstimator::step_foot(double dt_s, std::vector<EstimatedJoint>& joints, EstimatedLeg& out) noexcept {
  double vertical_bound_N = kNaN;
  if (position_rad_.allFinite()) {
    out.estimated_foot_in_hip_m = to_vec3(kinematics_->foot_in_hip_m(position_rad_));
    out.estimated_foot_velocity_m_s = to_vec3(kinematics_->jacobian(position_rad_) * velocity_rad_s_);
    if (output_torque_Nm_.allFinite()) write_force(joints, out, vertical_bound_N);
  }
  const ContactEstimate contact = contact_->step(out.foot_force_N[2], vertical_bound_N, dt_s);
  out.contact = contact.contact;
  out.contact_confidence = contact.confidence;
}

void LegEstimator::step_joints(double dt_s, std::vector<EstimatedJoint>& joints) noexcept {
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    EstimatedJoint& joint = joints[static_cast<std::size_t>(joints_[j])];
    estimators_[j].step(samples_[j], dt_s, joint);
    const int i = static_cast<int>(j);
    position_rad_[i] = joint.estimated_position_rad;
    velocity_rad_s_[i] = joint.estimated_velocity_rad_s;
    acceleration_rad_s2_[i] = joint.estimated_acceleration_rad_s2;
    output_torque_Nm_[i] = joint.gear_output_torque_Nm;
  }
}

void LegEstimator::write_force(std::vector<EstimatedJoint>& joints, EstimatedLeg& out,
                               double& vertical_bound_N) noexcept {
  const JointVector external_Nm =
      kinematics_->inverse_dynamics_Nm(position_rad_, velocity_rad_s_, acceleration_rad_s2_) -
      output_torque_Nm_;
  const LegJacobian to_force = damped_inverse(kinematics_->jacobian(position_rad_)).matrix;
  out.foot_force_N = to_vec3(to_force * external_Nm);
  vertical_bound_N = 0.0;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const int i = static_cast<int>(j);
    EstimatedJoint& joint = joints[static_cast<std::size_t>(joints_[j])];
    joint.external_torque_Nm = external_Nm[i];
    vertical_bound_N += std::abs(to_force(2, i)) * joint.gear_output_torque_bound_Nm;
  }
}

}  // namespace sprung
