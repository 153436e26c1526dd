#include "controller/leg_controller.h"

#include <algorithm>
#include <cmath>

#include "estimator/coulomb_friction.h"

namespace sprung {
namespace {

constexpr double kFade_s = 0.020;          // facts B2: switch over 20-30 ms
constexpr double kFadeSpeed_rad_s = 3.0;   // mean, a quarter of what the joints can do
constexpr double kPeakToMeanOfFade = 1.5;  // of the cubic
constexpr double kLongestPreload_rad =
    0.1;  // 50 Nm at the position loop of facts C2: a standing leg needs less

template <class T>
std::vector<T> pick(const std::vector<T>& all, const std::vector<int>& indices) {
  std::vector<T> out;
  out.reserve(indices.size());
  for (int i : indices) out.push_back(all.at(static_cast<std::size_t>(i)));
  return out;
}

/// Before friction and rotor inertia: the papers' joint torque has lost the papers' friction, whatever is identified.
double motor_torque_Nm(const JointConfig& joint, const EstimatedJoint& state) noexcept {
  return state.motor_side_torque_Nm +
         papers_friction(joint.coulomb_friction_Nm, state.estimated_velocity_rad_s).torque_Nm;
}

FrictionCompensation compensation(const std::vector<JointConfig>& joints, const PresetConfig& preset) {
  const bool paper = preset.compensated_friction == CompensatedFriction::kPaper;
  FrictionCompensation out;
  out.smoothing_rad_s = preset.friction_smoothing_rad_s;
  for (const JointConfig& joint : joints)
    out.joints.push_back(paper ? joint.papers_friction() : joint.estimated_friction());
  return out;
}

}  // namespace

LegController::LegController(const RobotConfig& robot, const LegConfig& leg, const PresetConfig& preset)
    : joint_indices_(leg.joints),
      actuator_indices_(leg.actuators),
      joints_(pick(robot.joints, leg.joints)),
      actuators_(pick(robot.actuators, leg.actuators)),
      kinematics_(make_leg_kinematics(leg)),
      transmission_(leg),
      friction_(compensation(joints_, preset)),
      limiters_(actuators_.begin(), actuators_.end()) {
  const int n = transmission_.size();
  for (JointVector* v : {&offset_, &motor_torque_Nm_, &measured_.position_rad, &measured_.velocity_rad_s,
                         &measured_.temperature_C, &lowest_rad_, &highest_rad_}) {
    v->setZero(n);
  }
}

LegOutcome LegController::step(const std::vector<EstimatedJoint>& joints, const DesiredLeg& desired,
                               double desired_age_s, double dt_s, DriveCommand& out) noexcept {
  if (desired.control_mode == ControlMode::kDisabled) {
    disable(out);
    return LegOutcome::kOk;
  }
  if (desired.control_mode == ControlMode::kDamping) {
    damp(out);
    return LegOutcome::kOk;
  }
  if (kinematics_ == nullptr && desired.control_mode != ControlMode::kJoint) return LegOutcome::kUnreachable;
  if (!read(joints)) return LegOutcome::kNotFinite;
  entering_ = entering_ || !all_enabled_ || desired.control_mode != mode_;
  const bool was_compliant = mode_ == ControlMode::kCompliance;
  mode_ = desired.control_mode;
  fade_.advance(dt_s);
  const LegOutcome outcome = follow(desired, desired_age_s, was_compliant, dt_s, out);
  entering_ = outcome != LegOutcome::kOk;
  return outcome;
}

LegOutcome LegController::follow(const DesiredLeg& desired, double desired_age_s, bool was_compliant,
                                 double dt_s, DriveCommand& out) noexcept {
  if (mode_ == ControlMode::kJoint) return joint(desired, desired_age_s, was_compliant, dt_s, out);
  const FootMotion foot = extrapolate(desired, desired_age_s);
  if (!foot.position_m.allFinite() || !foot.velocity_m_s.allFinite()) return LegOutcome::kNotFinite;
  return mode_ == ControlMode::kPosition ? position(foot, was_compliant, dt_s, out)
                                         : compliance(desired, foot, dt_s, out);
}

bool LegController::read(const std::vector<EstimatedJoint>& joints) noexcept {
  all_enabled_ = true;
  for (int j = 0; j < transmission_.size(); ++j) {
    const EstimatedJoint& joint =
        joints[static_cast<std::size_t>(joint_indices_[static_cast<std::size_t>(j)])];
    measured_.position_rad[j] = joint.estimated_position_rad;
    measured_.velocity_rad_s[j] = joint.estimated_velocity_rad_s;
    measured_.temperature_C[j] = joint.estimated_temperature_degC;
    motor_torque_Nm_[j] = motor_torque_Nm(joints_[static_cast<std::size_t>(j)], joint);
    all_enabled_ = all_enabled_ && joint.drive_enabled;
  }
  return measured_.position_rad.allFinite() && measured_.velocity_rad_s.allFinite() &&
         motor_torque_Nm_.allFinite();
}

LegOutcome LegController::position(const FootMotion& foot, bool was_compliant, double dt_s,
                                   DriveCommand& out) noexcept {
  const InverseResult inverse = kinematics_->inverse(foot.position_m, measured_.position_rad);
  if (!inverse.reachable) return LegOutcome::kUnreachable;
  const DampedInverse to_joints = damped_inverse(kinematics_->jacobian(inverse.position_rad));
  send_position({inverse.position_rad, to_joints.matrix.transpose() * foot.velocity_m_s}, was_compliant, dt_s,
                out);
  return LegOutcome::kOk;
}

LegOutcome LegController::joint(const DesiredLeg& desired, double desired_age_s, bool was_compliant,
                                double dt_s, DriveCommand& out) noexcept {
  LegMotion to = measured_;  // of this leg's size
  for (int j = 0; j < transmission_.size(); ++j) {
    const auto place = static_cast<std::size_t>(j);
    const bool known = place < desired.desired_joint_position_rad.size();
    to.velocity_rad_s[j] = known ? desired.desired_joint_velocity_rad_s[place] : kNaN;
    to.position_rad[j] =
        known ? desired.desired_joint_position_rad[place] + desired_age_s * to.velocity_rad_s[j] : kNaN;
  }
  if (!to.position_rad.allFinite() || !to.velocity_rad_s.allFinite()) return LegOutcome::kNotFinite;
  send_position(to, was_compliant, dt_s, out);
  return LegOutcome::kOk;
}

void LegController::send_position(const LegMotion& desired, bool was_compliant, double dt_s,
                                  DriveCommand& out) noexcept {
  if (entering_) enter_position(desired.position_rad, was_compliant);
  JointVector position_rad = desired.position_rad + fade_.share() * offset_;
  JointVector velocity_rad_s = desired.velocity_rad_s + fade_.rate_1_s() * offset_;
  if (!all_enabled_) {
    position_rad = measured_.position_rad;
    velocity_rad_s.setZero();
  }
  clamp_to_limits(dt_s, position_rad, velocity_rad_s);
  const JointVector position = transmission_.actuator_from_joint(position_rad);
  const JointVector velocity = transmission_.actuator_from_joint(velocity_rad_s);
  fill(out, DriveMode::kPosition);
  for (int i = 0; i < transmission_.size(); ++i) {
    const double fastest = actuators_[static_cast<std::size_t>(i)].speed_limit_rad_s;
    command(out, i).commanded_position_rad = position[i];
    command(out, i).commanded_velocity_rad_s = std::clamp(velocity[i], -fastest, fastest);
    if (std::abs(velocity[i]) > fastest) ++counts_.velocity;
  }
}

void LegController::enter_position(const JointVector& desired_rad, bool was_compliant) noexcept {
  offset_ = measured_.position_rad - desired_rad;
  if (was_compliant && all_enabled_) offset_ += held_by_stiffness_rad();
  fade_.start(std::max(kFade_s, kPeakToMeanOfFade * offset_.cwiseAbs().maxCoeff() / kFadeSpeed_rad_s));
}

/// How far beyond the measured position a set-point must be for the drives' position loops, torque = stiffness
/// * (set-point - measured), to give the torque that the motors give now. Zero where the stiffness is unknown.
JointVector LegController::held_by_stiffness_rad() const noexcept {
  JointVector beyond_rad = transmission_.actuator_torque(motor_torque_Nm_);
  for (int i = 0; i < beyond_rad.size(); ++i) {
    const double stiffness = actuators_[static_cast<std::size_t>(i)].position_stiffness_Nm_rad;
    const double needed_rad = stiffness > 0.0 ? beyond_rad[i] / stiffness : 0.0;
    beyond_rad[i] = std::clamp(needed_rad, -kLongestPreload_rad, kLongestPreload_rad);
  }
  return transmission_.joint_from_actuator(beyond_rad);
}

/// A joint that was beyond a limit when the mode began must not be pulled back at once: enabling would kick. From there
/// on the bound moves to the limit, and a joint that is pushed out later takes it nowhere.
void LegController::clamp_to_limits(double dt_s, JointVector& position_rad,
                                    JointVector& velocity_rad_s) noexcept {
  const double back_rad = kFadeSpeed_rad_s * dt_s;
  for (int j = 0; j < position_rad.size(); ++j) {
    const JointConfig& joint = joints_[static_cast<std::size_t>(j)];
    const double low = joint.position_min_rad + kPositionMargin_rad;
    const double high = joint.position_max_rad - kPositionMargin_rad;
    const double measured = measured_.position_rad[j];
    lowest_rad_[j] = std::min(low, entering_ ? measured : lowest_rad_[j] + back_rad);
    highest_rad_[j] = std::max(high, entering_ ? measured : highest_rad_[j] - back_rad);
    const double inside = std::clamp(position_rad[j], lowest_rad_[j], highest_rad_[j]);
    if (inside == position_rad[j]) continue;
    ++counts_.position;
    position_rad[j] = inside;
    velocity_rad_s[j] = 0.0;
  }
}

LegOutcome LegController::compliance(const DesiredLeg& desired, const FootMotion& foot, double dt_s,
                                     DriveCommand& out) noexcept {
  JointVector torque = compliance_torque_Nm(*kinematics_, desired, foot, measured_, friction_);
  if (!torque.allFinite()) return LegOutcome::kNotFinite;
  if (entering_) enter_compliance(torque);
  torque += fade_.share() * offset_;
  for (int j = 0; j < torque.size(); ++j) {
    const ActuatorConfig& a = actuators_[static_cast<std::size_t>(j)];
    torque[j] = with_soft_stop(torque[j], joints_[static_cast<std::size_t>(j)], measured_.position_rad[j],
                               measured_.velocity_rad_s[j], a.position_stiffness_Nm_rad,
                               a.position_damping_Nm_s_rad, counts_);
  }
  if (!all_enabled_) torque.setZero();
  const JointVector actuator_Nm = transmission_.actuator_torque(torque);
  fill(out, DriveMode::kTorque);
  for (int i = 0; i < transmission_.size(); ++i) {
    TorqueLimiter& limiter = limiters_[static_cast<std::size_t>(i)];
    command(out, i).commanded_torque_Nm = limiter.limit(actuator_Nm[i], dt_s, counts_);
  }
  return LegOutcome::kOk;
}

void LegController::enter_compliance(const JointVector& law_Nm) noexcept {
  const JointVector there_Nm = (all_enabled_ ? 1.0 : 0.0) * motor_torque_Nm_;
  offset_ = there_Nm - law_Nm;
  fade_.start(kFade_s);
  const JointVector actuator_Nm = transmission_.actuator_torque(there_Nm);
  for (int i = 0; i < transmission_.size(); ++i) {
    limiters_[static_cast<std::size_t>(i)].start_from(actuator_Nm[i]);
  }
}

void LegController::damp(DriveCommand& out) noexcept {
  mode_ = ControlMode::kDamping;
  entering_ = true;
  fill(out, DriveMode::kDamping);
  for (int i = 0; i < transmission_.size(); ++i) {
    command(out, i).commanded_damping_Nm_s_rad =
        actuators_[static_cast<std::size_t>(i)].safety_damping_Nm_s_rad;
  }
}

void LegController::disable(DriveCommand& out) noexcept {
  mode_ = ControlMode::kDisabled;
  entering_ = true;
  fill(out, DriveMode::kDisabled);
}

ActuatorCommand& LegController::command(DriveCommand& out, int i) const noexcept {
  return out.actuators[static_cast<std::size_t>(actuator_indices_[static_cast<std::size_t>(i)])];
}

void LegController::fill(DriveCommand& out, DriveMode mode) const noexcept {
  for (int i = 0; i < transmission_.size(); ++i) {
    command(out, i) = ActuatorCommand{};
    command(out, i).mode = mode;
  }
}

}  // namespace sprung
