#include "estimator/leg_estimator.h"

#include <algorithm>
#include <cmath>

#include "estimator/root_sum_square.h"
#include "model/friction/friction_law.h"

namespace sprung {
namespace {

/// Share of the leg's weight that the hip's acceleration may add or take away, one standard deviation: it is
/// between free fall (-1) and rest (0) in a swing, up to +2 in a thrust and at a landing.
constexpr double kHipAcceleration = 0.6;
/// Speed below which friction's sign may be wrong in a motion that reverses: what the motion filter is late
/// by, 0.5 ms, at 100 rad/s^2.
constexpr double kReversal_rad_s = 0.05;
constexpr double kStdsFor95 = 1.96;
/// What the motion filter is late by where torque jumps; and what is no jump yet, a share of what the
/// actuator can give in a cycle: as much a position loop changes at any touchdown.
constexpr double kLate_s = 0.3e-3;
constexpr double kNoJump = 0.075;
/// Correlation of two joints' errors: gears of one make, drives of one calibration, one hip that accelerates.
constexpr double kAlike = 0.25;
/// Noise of an external torque before any swing was seen, as a share of dry friction as large as it may be.
constexpr double kFirstNoise = 0.1;

/// Slower motion shows little of friction, and its sign may be late.
constexpr double kWatched_rad_s = 0.1;
/// A leg that has just left the ground: its gears untwist, and its foot may still be dragged.
constexpr double kSwings_s = 0.06;
/// A force that pulls, longer than any shock lasts.
constexpr double kPullStds = 3.0;
constexpr double kPull_s = 0.02;
/// Of what a model that does not fit was found to miss, how far it may be off elsewhere, one standard
/// deviation.
constexpr double kMissedShare = 0.1;

double dry_friction_Nm(const FrictionParameters& law, double output_torque_Nm) noexcept {
  FrictionInput in;
  in.gear_output_torque_Nm = output_torque_Nm;
  in.sign = 1.0;
  return friction_torque_Nm(law, in);
}

ResidualModel residual_model(const JointConfig& joint, double cycle_s) {
  const JointUncertainty& known = joint.uncertainty;
  return {{known.friction, known.armature, known.torque_constant, kHipAcceleration},
          kFirstNoise * (1.0 + known.friction) * dry_friction_Nm(joint.estimated_friction(), 0.0),
          cycle_s};
}

/// The joint's law is another robot's.
bool is_foreign(const RobotConfig& robot, const JointConfig& joint) {
  return joint.friction && identified_on_another(joint.friction->record, robot.name);
}

}  // namespace

LegEstimator::LegEstimator(const RobotConfig& robot, const LegConfig& leg, int longest_coast_cycles)
    : joints_(leg.joints),
      sampler_(robot, leg),
      windings_(robot, leg),
      kinematics_(make_leg_kinematics(leg)),
      unnoticed_N_(leg.contact_on_N),
      samples_(leg.joints.size()),
      evidence_(leg.joints.size()),
      last_motor_torque_Nm_(leg.joints.size(), kNaN) {
  const int n = static_cast<int>(joints_.size());
  std::vector<ResidualModel> residuals;
  for (int j = 0; j < n; ++j) {
    const auto place = static_cast<std::size_t>(j);
    const JointConfig& joint = robot.joints.at(static_cast<std::size_t>(joints_[place]));
    configs_.push_back(joint);
    friction_laws_.push_back(joint.estimated_friction());
    estimators_.emplace_back(joint, robot.estimation, robot.cycle_s, sampler_.encoder_step_rad(j),
                             longest_coast_cycles);
    const double limit_Nm = robot.actuators.at(static_cast<std::size_t>(leg.actuators[place]))
                                .torque_limit_Nm;
    no_jump_Nm_.push_back(kNoJump * limit_Nm);
    watches_.emplace_back(joint.uncertainty, joint.estimated_friction(),
                          is_foreign(robot, joint) ? limit_Nm : 0.0);
    residuals.push_back(residual_model(joint, robot.cycle_s));
  }
  if (kinematics_ != nullptr)
    contact_.emplace(
        ContactParams{leg.contact_on_N, leg.contact_off_N, leg.contact_rise_s, leg.contact_fall_s,
                      robot.body.mass_kg > 0.0 ? robot.estimation.floor_force_N : 0.0},
        std::move(residuals));
  for (JointVector* v : {&position_rad_, &velocity_rad_s_, &acceleration_rad_s2_, &output_torque_Nm_,
                         &link_torque_Nm_, &weight_Nm_, &external_bound_Nm_})
    v->resize(n);
  external_torque_Nm_.setConstant(n, kNaN);
}

void LegEstimator::reset() noexcept {
  for (JointEstimator& e : estimators_) e.reset();
  for (ModelWatch& watch : watches_) watch.freeze();
  if (contact_) contact_->reset();
  external_torque_Nm_.setConstant(kNaN);
  std::fill(last_motor_torque_Nm_.begin(), last_motor_torque_Nm_.end(), kNaN);
}

void LegEstimator::step(const std::vector<ActuatorState>& actuators, double dt_s,
                        std::vector<EstimatedJoint>& joints, EstimatedLeg& out) noexcept {
  sample(actuators);
  windings_.step(actuators, dt_s);
  step_joints(dt_s, joints);
  out = EstimatedLeg{};
  if (kinematics_ != nullptr) step_foot(dt_s, joints, out);
}

void LegEstimator::sample(const std::vector<ActuatorState>& actuators) noexcept {
  sampler_.sample(actuators, samples_);
  for (std::size_t j = 0; j < samples_.size(); ++j) {
    samples_[j].untouched = contact_ && contact_->surely_free();
    samples_[j].last_external_torque_Nm = external_torque_Nm_[static_cast<int>(j)];
  }
  external_torque_Nm_.setConstant(kNaN);
}

void LegEstimator::step_joints(double dt_s, std::vector<EstimatedJoint>& joints) noexcept {
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    EstimatedJoint& joint = joints[joints_[j]];
    estimators_[j].step(samples_[j], dt_s, joint);
    const int i = static_cast<int>(j);
    position_rad_[i] = joint.estimated_position_rad;
    velocity_rad_s_[i] = joint.estimated_velocity_rad_s;
    acceleration_rad_s2_[i] = joint.estimated_acceleration_rad_s2;
    output_torque_Nm_[i] = joint.gear_output_torque_Nm;
    widen_bounds(j, joint);
    windings_.write(j, joint);
  }
}

void LegEstimator::step_foot(double dt_s, std::vector<EstimatedJoint>& joints, EstimatedLeg& out) noexcept {
  if (!position_rad_.allFinite() || !output_torque_Nm_.allFinite()) {
    if (position_rad_.allFinite()) write_motion(out);
    contact_->reset();
    for (ModelWatch& watch : watches_) watch.freeze();
    return;
  }
  write_motion(out);
  write_force(joints, out);
  gather_evidence(dt_s, joints);
  const ContactEstimate contact = contact_->step(evidence_, dt_s);
  out.contact = contact.contact;
  out.contact_confidence = contact.confidence;
  watch_models(out.foot_force_N[2], dt_s, joints);
  watch_force(contact, dt_s, joints);
}

WatchedMotion LegEstimator::watched(std::size_t j, const EstimatedJoint& joint) const noexcept {
  const int i = static_cast<int>(j);
  WatchedMotion motion;
  motion.velocity_rad_s = joint.estimated_velocity_rad_s;
  motion.sign = joint.at_rest ? 1.0 : std::copysign(1.0, motion.velocity_rad_s);
  motion.output_torque_Nm = joint.gear_output_torque_Nm;
  motion.inertia_torque_Nm = configs_[j].armature_kg_m2 * joint.estimated_acceleration_rad_s2;
  motion.motor_torque_Nm = joint.measured_motor_torque_Nm;
  motion.weight_Nm = weight_Nm_[i];
  motion.friction_Nm = joint.friction_torque_Nm;
  motion.friction_by_law = estimators_[j].friction_by_law();
  if (!joint.at_rest)
    motion.adapted_Nm = motion.friction_by_law.torque_Nm(
                            {joint.dry_friction_factor, joint.viscous_friction_factor}) -
                        motion.friction_by_law.torque_Nm({});
  motion.link_torque_Nm = link_torque_Nm_[i];
  return motion;
}

void LegEstimator::widen_bounds(std::size_t j, EstimatedJoint& joint) const noexcept {
  const ModelWatch& watch = watches_[j];
  joint.model_fits = watch.fits();
  joint.misfit_reason = watch.reason();
  joint.misfit_ratio = watch.ratio();
  const double missed_Nm = watch.missed(watched(j, joint)).bound_Nm();
  if (!(missed_Nm > 0.0)) return;
  joint.gear_output_torque_bound_Nm = root_sum_square(joint.gear_output_torque_bound_Nm, missed_Nm);
  joint.friction_torque_bound_Nm = root_sum_square(joint.friction_torque_bound_Nm, missed_Nm);
}

/// The drive moves the joint, and nothing touches the leg: what is not explained is the model's own. A force
/// that looks upward may be one that is not noticed; ground pulls nothing down.
void LegEstimator::watch_models(double force_N, double dt_s, std::vector<EstimatedJoint>& joints) noexcept {
  const bool free = contact_->free_s() > kSwings_s;
  const double unnoticed_N = force_N > 0.0 ? std::max(unnoticed_N_, force_N) : 0.0;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const EstimatedJoint& joint = joints[joints_[j]];
    const bool measured = joint.status == JointStatus::kOk || joint.status == JointStatus::kSaturated;
    if (!free || !measured || !joint.drive_enabled) {
      watches_[j].freeze();
    } else if (!moved_from_outside(j) && !joint.at_rest &&
               std::abs(joint.estimated_velocity_rad_s) > kWatched_rad_s) {
      const double noise_Nm = configs_[j].armature_kg_m2 * joint.estimated_acceleration_bound_rad_s2 /
                              kStdsFor95;
      WatchedMotion motion = watched(j, joint);
      motion.moves_itself = moves_itself(j);
      motion.unnoticed_Nm = unnoticed_N * jacobian_.col(static_cast<int>(j)).norm();
      const SeenFriction* seen = watches_[j].learn(motion, joint.external_torque_Nm, noise_Nm, dt_s);
      if (seen != nullptr) estimators_[j].learn_friction(*seen);
    }
  }
}

double LegEstimator::motor_power_W(std::size_t j) const noexcept {
  return samples_[j].motor_torque_Nm * velocity_rad_s_[static_cast<int>(j)];
}

double LegEstimator::motor_power_W() const noexcept {
  double sum_W = 0.0;
  for (std::size_t j = 0; j < samples_.size(); ++j) sum_W += motor_power_W(j);
  return sum_W;
}

/// Motors drive this joint and the leg: a hand that moves a leg on its springs is not friction.
bool LegEstimator::moves_itself(std::size_t j) const noexcept {
  return motor_power_W() > 0.0 && motor_power_W(j) > 0.0;
}

/// Motors brake this joint and the leg: perhaps a hand moves it, and what a hand does looks like a gear that
/// has less friction than its law. A swing's own braking is left out too; its other half shows as much.
bool LegEstimator::moved_from_outside(std::size_t j) const noexcept {
  return motor_power_W() < 0.0 && motor_power_W(j) < 0.0;
}

void LegEstimator::write_motion(EstimatedLeg& out) noexcept {
  pose_ = kinematics_->pose(position_rad_);
  jacobian_ = kinematics_->jacobian(pose_);
  out.estimated_foot_in_hip_m = to_vec3(kinematics_->foot_in_hip_m(pose_));
  out.estimated_foot_velocity_m_s = to_vec3(jacobian_ * velocity_rad_s_);
  last_link_rate_rad_s_ = kinematics_->last_link_rate_rad_s(pose_, velocity_rad_s_);
}

void LegEstimator::write_force(std::vector<EstimatedJoint>& joints, EstimatedLeg& out) noexcept {
  link_torque_Nm_ = kinematics_->inverse_dynamics_Nm(pose_, velocity_rad_s_, acceleration_rad_s2_);
  weight_Nm_ = kinematics_->gravity_torque_Nm(pose_);
  external_torque_Nm_ = link_torque_Nm_ - output_torque_Nm_;
  const LegJacobian to_force = damped_inverse(jacobian_).matrix;
  out.foot_force_N = to_vec3(to_force * external_torque_Nm_);
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const int i = static_cast<int>(j);
    EstimatedJoint& joint = joints[joints_[j]];
    joint.external_torque_Nm = external_torque_Nm_[i];
    joint.external_torque_bound_Nm = root_sum_square(
        joint.gear_output_torque_bound_Nm,
        kStdsFor95 * root_sum_square(configs_[j].uncertainty.mass * link_torque_Nm_[i],
                                     kHipAcceleration * weight_Nm_[i]));
    external_bound_Nm_[i] = joint.external_torque_bound_Nm;
  }
  for (int axis = 0; axis < 3; ++axis) {
    double sum_N = 0.0, squares_N2 = 0.0;
    for (int i = 0; i < external_bound_Nm_.size(); ++i) {
      const double bound_N = std::abs(to_force(axis, i)) * external_bound_Nm_[i];
      sum_N += bound_N;
      squares_N2 += bound_N * bound_N;
    }
    out.foot_force_bound_N[axis] = std::sqrt(kAlike * sum_N * sum_N + (1.0 - kAlike) * squares_N2);
  }
}

/// Ground cannot pull: a force of so many standard deviations down is the model's error, be the foot in the
/// air or on the ground. Of the joints that move.
void LegEstimator::watch_force(const ContactEstimate& contact, double dt_s,
                               const std::vector<EstimatedJoint>& joints) noexcept {
  const bool pulls = contact.force_N < -kPullStds * contact.force_std_N - unnoticed_N_;
  pulling_s_ = pulls ? pulling_s_ + dt_s : 0.0;
  if (pulling_s_ < kPull_s) return;
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    if (!joints[joints_[j]].at_rest) watches_[j].doubt();
  }
}

/// Half-width of what the motion filter, late, makes of a motor torque that changes: a drive that changes its
/// mode jumps by 100 Nm.
double LegEstimator::late_torque_Nm(std::size_t j, double motor_torque_Nm, double dt_s) noexcept {
  const double change_Nm = std::abs(motor_torque_Nm - last_motor_torque_Nm_[j]) - no_jump_Nm_[j];
  last_motor_torque_Nm_[j] = motor_torque_Nm;
  return change_Nm > 0.0 && dt_s > 0.0 ? kLate_s / dt_s * change_Nm : 0.0;
}

void LegEstimator::gather_evidence(double dt_s, const std::vector<EstimatedJoint>& joints) noexcept {
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const int i = static_cast<int>(j);
    const EstimatedJoint& joint = joints[joints_[j]];
    const double inertia_Nm = configs_[j].armature_kg_m2 * acceleration_rad_s2_[i];
    const double motor_Nm = output_torque_Nm_[i] + joint.friction_torque_Nm + inertia_Nm;
    const double slow = velocity_rad_s_[i] / kReversal_rad_s;
    JointResidual& residual = evidence_[j].residual;
    // At rest what is missed has no sign, and the bound below has it.
    const ModelWatch::Missed missed = joint.at_rest ? ModelWatch::Missed{}
                                                    : watches_[j].missed_if_free(watched(j, joint));
    residual.torque_Nm = joint.external_torque_Nm + missed.torque_Nm;
    residual.misfit_Nm2 = missed.std_Nm * missed.std_Nm +
                          kMissedShare * kMissedShare * missed.torque_Nm * missed.torque_Nm;
    residual.part_Nm = {joint.at_rest ? 0.0 : joint.friction_torque_Nm, inertia_Nm, motor_Nm, weight_Nm_[i]};
    residual.unknown_friction_Nm = joint.at_rest
                                       ? joint.gear_output_torque_bound_Nm
                                       : std::exp(-slow * slow) *
                                             dry_friction_Nm(friction_laws_[j], output_torque_Nm_[i]);
    residual.unknown_friction_Nm += late_torque_Nm(j, joint.measured_motor_torque_Nm, dt_s);
    evidence_[j].lever_m = jacobian_(2, i);
    evidence_[j].tangential_lever_m = {jacobian_(0, i), jacobian_(1, i)};
  }
}

}  // namespace sprung
