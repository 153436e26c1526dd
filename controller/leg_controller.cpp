#include "controller/leg_controller.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

constexpr double kModeFadeStep = 0.045;        // of the torque limit in a cycle: under 5 %
constexpr double kBackIntoLimits_rad_s = 3.0;  // a quarter of what the joints can do

template <class T>
std::vector<T> pick(const std::vector<T>& all, const std::vector<int>& indices) {
  std::vector<T> out;
  out.reserve(indices.size());
  for (int i : indices) out.push_back(all.at(i));
  return out;
}

JointCompensation compensation(const std::vector<JointConfig>& joints, const PresetConfig& preset) {
  const bool paper = preset.compensated_friction == CompensatedFriction::kPaper;
  JointCompensation out;
  out.smoothing_rad_s = preset.friction_smoothing_rad_s;
  out.rest = preset.rest_friction;
  for (const JointConfig& joint : joints) {
    out.friction.push_back(paper ? joint.papers_friction() : joint.estimated_friction());
    out.friction_uncertainty.push_back(joint.friction ? joint.uncertainty.friction : 0.0);
    out.armature_kg_m2.push_back(joint.armature_kg_m2);
    out.stuck_share.push_back(0.0);
  }
  return out;
}

bool in_position_loop(ControlMode mode) noexcept {
  return mode == ControlMode::kPosition || mode == ControlMode::kJoint;
}

}  // namespace

LegController::LegController(const RobotConfig& robot, const LegConfig& leg, const PresetConfig& preset)
    : joint_indices_(leg.joints),
      actuator_indices_(leg.actuators),
      joints_(pick(robot.joints, leg.joints)),
      actuators_(pick(robot.actuators, leg.actuators)),
      kinematics_(make_leg_kinematics(leg)),
      transmission_(leg),
      compensation_(compensation(joints_, preset)),
      friction_laws_(compensation_.friction),
      known_friction_(compensation_.friction_uncertainty),
      learns_friction_(preset.compensated_friction == CompensatedFriction::kIdentified),
      blend_(actuators_),
      gains_(preset.stiffness_ramp_s),
      stuck_(joints_.size(), StuckFriction(preset.rest_friction)),
      limiters_(actuators_.begin(), actuators_.end()),
      windows_(actuators_.begin(), actuators_.end()) {
  const int n = transmission_.size();
  for (JointVector* v :
       {&offset_Nm_, &motor_torque_Nm_, &measured_.position_rad, &measured_.velocity_rad_s,
        &measured_.temperature_C, &lowest_rad_, &highest_rad_, &sent_.position_rad, &sent_.velocity_rad_s}) {
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
  before_ = all_enabled_ ? mode_ : ControlMode::kDisabled;
  if (!read(joints)) return LegOutcome::kNotFinite;
  entering_ = entering_ || !all_enabled_ || desired.control_mode != mode_;
  mode_ = desired.control_mode;
  const LegOutcome outcome = follow(desired, desired_age_s, dt_s, out);
  entering_ = outcome != LegOutcome::kOk;
  return outcome;
}

LegOutcome LegController::follow(const DesiredLeg& desired, double desired_age_s, double dt_s,
                                 DriveCommand& out) noexcept {
  if (mode_ == ControlMode::kJoint) return joint(desired, desired_age_s, dt_s, out);
  const FootMotion foot = extrapolate(desired, desired_age_s);
  if (!foot.position_m.allFinite() || !foot.velocity_m_s.allFinite()) return LegOutcome::kNotFinite;
  return mode_ == ControlMode::kPosition ? position(desired, foot, dt_s, out)
                                         : compliance(desired, foot, dt_s, out);
}

bool LegController::read(const std::vector<EstimatedJoint>& joints) noexcept {
  all_enabled_ = true;
  for (int j = 0; j < transmission_.size(); ++j) {
    const EstimatedJoint& joint = joints[joint_indices_[j]];
    measured_.position_rad[j] = joint.estimated_position_rad;
    measured_.velocity_rad_s[j] = joint.estimated_velocity_rad_s;
    measured_.temperature_C[j] = joint.estimated_temperature_degC;
    motor_torque_Nm_[j] = joint.measured_motor_torque_Nm;
    all_enabled_ = all_enabled_ && joint.drive_enabled;
    compensate_friction(static_cast<std::size_t>(j), joint);
  }
  return measured_.position_rad.allFinite() && measured_.velocity_rad_s.allFinite() &&
         motor_torque_Nm_.allFinite();
}

/// The law with what was learnt beside it. In motion no more is compensated than surely is there: less of a
/// joint that its model does not fit.
void LegController::compensate_friction(std::size_t j, const EstimatedJoint& joint) noexcept {
  if (learns_friction_)
    compensation_.friction[j] = scaled(friction_laws_[j],
                                       {joint.dry_friction_factor, joint.viscous_friction_factor});
  const double stated = joints_[j].uncertainty.friction;
  const double misfit = joint.model_fits ? 0.0 : std::max(kMisfitRatio, joint.misfit_ratio);
  compensation_.friction_uncertainty[j] = std::max(known_friction_[j], std::min(1.0, stated * misfit));
}

LegOutcome LegController::position(const DesiredLeg& desired, const FootMotion& foot, double dt_s,
                                   DriveCommand& out) noexcept {
  const InverseResult inverse = kinematics_->inverse(foot.position_m, measured_.position_rad);
  if (!inverse.reachable) return LegOutcome::kUnreachable;
  const PosedLeg at = posed(*kinematics_, inverse.position_rad);
  const SetPoints to{inverse.position_rad, joint_velocity_rad_s(at, foot.velocity_m_s)};
  feed_forward(desired, foot, at, to);
  send_position(to, dt_s, out);
  return LegOutcome::kOk;
}

/// The drive's own loop takes position set-points alone, and lags behind a quick swing by all that its rotor
/// takes.
void LegController::feed_forward(const DesiredLeg& desired, const FootMotion& foot, const PosedLeg& at,
                                 const SetPoints& to) noexcept {
  JointVector torque_Nm = JointVector::Zero(transmission_.size());
  if (desired.inertia_compensation > 0.0)
    torque_Nm = led_torque_Nm(*kinematics_, at, desired, foot,
                              {to.position_rad, to.velocity_rad_s, measured_.temperature_C}, compensation_);
  if (!torque_Nm.allFinite()) torque_Nm.setZero();
  blend_.feed_forward(transmission_.actuator_torque(torque_Nm));
}

LegOutcome LegController::joint(const DesiredLeg& desired, double desired_age_s, double dt_s,
                                DriveCommand& out) noexcept {
  SetPoints to{measured_.position_rad, measured_.velocity_rad_s};  // of this leg's size
  for (int j = 0; j < transmission_.size(); ++j) {
    const auto place = static_cast<std::size_t>(j);
    const bool known = place < desired.desired_joint_position_rad.size();
    to.velocity_rad_s[j] = known ? desired.desired_joint_velocity_rad_s[place] : kNaN;
    to.position_rad[j] = known ? desired.desired_joint_position_rad[place] +
                                     desired_age_s * to.velocity_rad_s[j]
                               : kNaN;
  }
  if (!to.position_rad.allFinite() || !to.velocity_rad_s.allFinite()) return LegOutcome::kNotFinite;
  blend_.feed_forward(JointVector::Zero(transmission_.size()));
  send_position(to, dt_s, out);
  return LegOutcome::kOk;
}

void LegController::send_position(const SetPoints& desired, double dt_s, DriveCommand& out) noexcept {
  blend_.advance(dt_s);
  if (entering_) enter_position(desired, dt_s);
  sent_ = desired;
  blend_.add_motion(sent_);
  if (!all_enabled_) {
    sent_.position_rad = measured_.position_rad;
    sent_.velocity_rad_s.setZero();
  }
  clamp_to_limits(dt_s, sent_.position_rad, sent_.velocity_rad_s);
  SetPoints actuators{transmission_.actuator_from_joint(sent_.position_rad),
                      transmission_.actuator_from_joint(sent_.velocity_rad_s)};
  blend_.add_torque(actuators);
  send(actuators, dt_s, out);
}

void LegController::send(const SetPoints& actuators, double dt_s, DriveCommand& out) noexcept {
  const JointVector measured_rad = transmission_.actuator_from_joint(measured_.position_rad);
  fill(out, DriveMode::kPosition);
  for (int i = 0; i < transmission_.size(); ++i) {
    const auto place = static_cast<std::size_t>(i);
    const double fastest = actuators_[place].speed_limit_rad_s;
    command(out, i).commanded_position_rad = windows_[place].hold(actuators.position_rad[i], measured_rad[i],
                                                                  dt_s);
    command(out, i).commanded_velocity_rad_s = std::clamp(actuators.velocity_rad_s[i], -fastest, fastest);
    if (windows_[place].acts()) ++counts_.window;
    if (std::abs(actuators.velocity_rad_s[i]) > fastest) ++counts_.velocity;
  }
}

/// Between position and joints the set-points go on, and with them what is left of an older torque.
void LegController::enter_position(const SetPoints& desired, double dt_s) noexcept {
  if (in_position_loop(before_) && all_enabled_) {
    const SetPoints on{sent_.position_rad + dt_s * sent_.velocity_rad_s, sent_.velocity_rad_s};
    blend_.start_motion(on, desired);
    return;
  }
  blend_.start_motion({measured_.position_rad, measured_.velocity_rad_s}, desired);
  const bool loaded = before_ != ControlMode::kDisabled && all_enabled_;
  blend_.start_torque((loaded ? 1.0 : 0.0) * transmission_.actuator_torque(motor_torque_Nm_), dt_s);
}

/// A joint that was beyond a limit when the mode began must not be pulled back at once: enabling would kick.
/// From there on the bound moves to the limit, and a joint that is pushed out later takes it nowhere.
void LegController::clamp_to_limits(double dt_s, JointVector& position_rad,
                                    JointVector& velocity_rad_s) noexcept {
  const double back_rad = kBackIntoLimits_rad_s * dt_s;
  for (int j = 0; j < position_rad.size(); ++j) {
    const JointConfig& joint = joints_[j];
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
  fade_.advance(dt_s);
  DesiredLeg acting = desired;
  if (entering_) gains_.start(desired);
  const bool free = all_enabled_ && desired.phase != LegPhase::kStance;
  if (entering_ || !free) forget_stuck();
  gains_.advance(dt_s, acting);
  const ComplianceTorque law = compliance_torque(*kinematics_, acting, foot, measured_, compensation_);
  JointVector torque = law.torque_Nm;
  if (!torque.allFinite()) return LegOutcome::kNotFinite;
  if (free) learn_stuck(acting, law, dt_s);
  add_soft_stops(torque);
  if (entering_) enter_compliance(torque, dt_s);
  torque += fade_.share() * offset_Nm_;
  if (!all_enabled_) torque.setZero();
  const JointVector actuator_Nm = transmission_.actuator_torque(torque);
  const JointVector actuator_rad_s = transmission_.actuator_from_joint(measured_.velocity_rad_s);
  fill(out, DriveMode::kTorque);
  for (int i = 0; i < transmission_.size(); ++i) {
    TorqueLimiter& limiter = limiters_[i];
    command(out, i).commanded_torque_Nm = limiter.limit(actuator_Nm[i], actuator_rad_s[i], dt_s, counts_);
  }
  return LegOutcome::kOk;
}

void LegController::forget_stuck() noexcept {
  for (std::size_t j = 0; j < stuck_.size(); ++j) {
    stuck_[j].reset();
    compensation_.stuck_share[j] = 0.0;
  }
}

void LegController::learn_stuck(const DesiredLeg& acting, const ComplianceTorque& law, double dt_s) noexcept {
  for (std::size_t j = 0; j < stuck_.size(); ++j) {
    const auto i = static_cast<Eigen::Index>(j);
    stuck_[j].step({measured_.velocity_rad_s[i], law.spring_torque_Nm[i], law.rest_friction_Nm[i],
                    acting.friction_compensation},
                   dt_s);
    compensation_.stuck_share[j] = stuck_[j].share();
  }
}

void LegController::add_soft_stops(JointVector& torque_Nm) noexcept {
  for (int j = 0; j < torque_Nm.size(); ++j) {
    const ActuatorConfig& a = actuators_[j];
    torque_Nm[j] = with_soft_stop(torque_Nm[j], joints_[j], measured_.position_rad[j],
                                  measured_.velocity_rad_s[j], a.position_stiffness_Nm_rad,
                                  a.position_damping_Nm_s_rad, counts_);
  }
}

void LegController::enter_compliance(const JointVector& law_Nm, double dt_s) noexcept {
  const JointVector there_Nm = (all_enabled_ ? 1.0 : 0.0) * motor_torque_Nm_;
  offset_Nm_ = there_Nm - law_Nm;
  const JointVector actuator_Nm = transmission_.actuator_torque(there_Nm);
  const JointVector change_Nm = transmission_.actuator_torque(offset_Nm_);
  double share = 0.0;
  for (int i = 0; i < transmission_.size(); ++i) {
    limiters_[i].start_from(actuator_Nm[i]);
    share = std::max(share, std::abs(change_Nm[i]) / actuators_[i].torque_limit_Nm);
  }
  fade_.start(fade_time_s(share, kModeFadeStep, dt_s));
}

void LegController::damp(DriveCommand& out) noexcept {
  mode_ = ControlMode::kDamping;
  entering_ = true;
  fill(out, DriveMode::kDamping);
  for (int i = 0; i < transmission_.size(); ++i) {
    command(out, i).commanded_damping_Nm_s_rad = actuators_[i].safety_damping_Nm_s_rad;
  }
}

void LegController::disable(DriveCommand& out) noexcept {
  mode_ = ControlMode::kDisabled;
  entering_ = true;
  fill(out, DriveMode::kDisabled);
}

ActuatorCommand& LegController::command(DriveCommand& out, int i) const noexcept {
  return out.actuators[actuator_indices_[i]];
}

void LegController::fill(DriveCommand& out, DriveMode mode) const noexcept {
  for (int i = 0; i < transmission_.size(); ++i) {
    command(out, i) = ActuatorCommand{};
    command(out, i).mode = mode;
  }
}

}  // namespace sprung
