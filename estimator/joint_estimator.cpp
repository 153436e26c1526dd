#include "estimator/joint_estimator.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

#include "estimator/root_sum_square.h"
#include "estimator/torque_bound.h"
#include "model/friction/coulomb_friction.h"

namespace sprung {
namespace {

/// The estimate is good this long after the start.
constexpr double kSettling_s = 0.013;
/// An encoder step is spread evenly: 1 / sqrt 12.
constexpr double kStepStd = 0.2886751345948129;
/// At the start the load is known as well as breakaway friction lets it be; what is not identified may be
/// this much.
constexpr double kStartStd_Nm = 10.0;
/// Slower cycles cannot follow a leg's impact: 4 ms are half of its rise on soft ground.
constexpr double kLongestCycle_s = 1.0 / 250.0;
/// Encoders that disagree by more do not show a twist: 0.01 rad are 250 Nm and more (facts papers D8).
constexpr double kMostTwist_rad = 0.01;
constexpr double kLeastArmature_kg_m2 = 1e-9;

std::string too_slow(double cycle_s) {
  char text[200];
  std::snprintf(text, sizeof text,
                "robot.yaml: key 'cycle_rate': found %g Hz, expected at least %.0f Hz, below which the "
                "estimator cannot "
                "follow a joint: raise it",
                1.0 / cycle_s, 1.0 / kLongestCycle_s);
  return text;
}

/// A joint without armature in its file has no inertia to divide by: its filter then follows the encoder
/// alone.
double inertia(const JointConfig& joint) noexcept {
  return std::max(joint.armature_kg_m2, kLeastArmature_kg_m2);
}

double walk_density(const JointConfig& joint, const EstimationConfig& estimation) noexcept {
  const double walk_rad_s2 = estimation.load_walk_Nm_sqrt_s / inertia(joint);
  return walk_rad_s2 * walk_rad_s2;
}

/// Drives hold each current for one turn of their loop, n in a cycle, so that the newest of two samples
/// counts (n + 1) / (2 n) in the mean between them.
double newest_share(const EstimationConfig& estimation, double cycle_s) noexcept {
  const double turns = std::max(1.0, 1000.0 * estimation.drive_loop_kHz * cycle_s);
  return (turns + 1.0) / (2.0 * turns);
}

}  // namespace

JointEstimator::JointEstimator(const JointConfig& joint, const EstimationConfig& estimation, double cycle_s,
                               double encoder_step_rad, int longest_coast_cycles)
    : joint_(joint),
      estimation_(estimation),
      newest_share_(newest_share(estimation, cycle_s)),
      encoder_step_rad_(encoder_step_rad),
      longest_coast_cycles_(longest_coast_cycles),
      settling_samples_(static_cast<int>(std::ceil(kSettling_s / cycle_s))),
      filter_(walk_density(joint, estimation)),
      friction_(joint),
      adaptation_(joint.uncertainty.friction, estimation.adapts_friction),
      temperature_(joint.estimated_friction(), joint.thermal) {
  if (!(cycle_s > 0.0 && cycle_s <= kLongestCycle_s)) throw std::invalid_argument(too_slow(cycle_s));
  temperature_.reset();
  reset();
}

void JointEstimator::reset() noexcept {
  motor_torque_Nm_ = kNaN;
  input_rad_s2_ = 0.0;
  torsion_zero_.reset();
  fresh_samples_ = 0;
  coasted_cycles_ = 0;
}

void JointEstimator::step(const JointSample& sample, double dt_s, EstimatedJoint& out) noexcept {
  const bool was_stale = coasted_cycles_ > longest_coast_cycles_;
  const bool referenced = sample.drive_status != JointStatus::kNotReferenced;
  if (sample.fresh && (was_stale || referenced != referenced_)) reset();  // homing moves the zero
  referenced_ = referenced;
  adaptation_.age(dt_s);
  friction_.adapt(adaptation_.factors());
  if (fresh_samples_ > 0) {
    follow_temperature(sample, dt_s);
    track(sample, dt_s);
  } else if (sample.fresh) {
    start(sample);
  } else {
    ++coasted_cycles_;
  }
  out = EstimatedJoint{};
  out.status = status(sample);
  out.drive_enabled = sample.drive_enabled;
  out.identified = joint_.friction.has_value();
  out.dry_friction_factor = adaptation_.factors().dry;
  out.viscous_friction_factor = adaptation_.factors().viscous;
  if (fresh_samples_ > 0) write_motion(out);
  if (fresh_samples_ > 0 && out.status != JointStatus::kStale) {
    write_torques(out);
    if (sample.fresh) fuse_torsion(sample, dt_s, out);
  }
}

/// At rest, and the link balances the motor: nothing accelerates, so nothing jumps.
void JointEstimator::start(const JointSample& sample) noexcept {
  reset();
  motor_torque_Nm_ = sample.motor_torque_Nm;
  quantisation_Nm_ = sample.current_quantisation_Nm;
  input_rad_s2_ = motor_torque_Nm_ / inertia(joint_);
  filter_.start(sample.measured_position_rad, -input_rad_s2_, encoder_step_rad_,
                kStartStd_Nm / inertia(joint_));
  friction_.start(sample.measured_position_rad, motor_torque_Nm_);
  fresh_samples_ = 1;
}

void JointEstimator::track(const JointSample& sample, double dt_s) noexcept {
  if (sample.fresh) {
    use(sample, dt_s);
    coasted_cycles_ = 0;
    if (fresh_samples_ < settling_samples_) ++fresh_samples_;
  } else {
    ++coasted_cycles_;
    filter_.predict(dt_s, input_rad_s2_);
  }
}

void JointEstimator::use(const JointSample& sample, double dt_s) noexcept {
  const double mean_Nm = newest_share_ * sample.motor_torque_Nm + (1.0 - newest_share_) * motor_torque_Nm_;
  filter_.predict(dt_s, (mean_Nm - friction_.ahead_Nm(mean_Nm)) / inertia(joint_));
  filter_.correct(sample.measured_position_rad, sampling_std_rad());
  motor_torque_Nm_ = sample.motor_torque_Nm;
  quantisation_Nm_ = sample.current_quantisation_Nm;
  GearFrictionEstimator::Motion motion;
  motion.measured_position_rad = sample.measured_position_rad;
  motion.velocity_rad_s = filter_.velocity_rad_s();
  motion.velocity_std_rad_s = filter_.velocity_std_rad_s();
  motion.motor_torque_Nm = motor_torque_Nm_;
  motion.tracked_output_Nm = -inertia(joint_) * filter_.unexplained_rad_s2();
  motion.tracked_output_std_Nm = inertia(joint_) * filter_.unexplained_std_rad_s2();
  motion.temperature_C = temperature_.temperature_C();
  motion.dt_s = dt_s;
  friction_.update(motion);
  input_rad_s2_ = (motor_torque_Nm_ - friction_.friction_torque_Nm()) / inertia(joint_);
}

/// By what the last cycle found. Only while the drive moves the joint: whoever moves it by hand is no
/// friction.
void JointEstimator::follow_temperature(const JointSample& sample, double dt_s) noexcept {
  if (!temperature_.configured()) return;
  temperature_.predict(friction_.friction_torque_Nm(), filter_.velocity_rad_s(), dt_s);
  const bool settled = fresh_samples_ >= settling_samples_ && coasted_cycles_ == 0;
  if (!settled || friction_.at_rest() || !sample.untouched || !sample.drive_enabled) return;
  if (!estimation_.adapts_friction) return;  // warmth by what the motors lose alone
  temperature_.observe(motion_now(), -sample.last_external_torque_Nm, dt_s);
}

FrictionInput JointEstimator::motion_now() const noexcept {
  FrictionInput at;
  at.velocity_rad_s = filter_.velocity_rad_s();
  at.gear_output_torque_Nm = friction_.output_torque_Nm();
  return at;
}

double JointEstimator::sampling_std_rad() const noexcept {
  return root_sum_square(kStepStd * encoder_step_rad_,
                         1e-6 * estimation_.sampling_jitter_us * filter_.velocity_rad_s());
}

JointStatus JointEstimator::status(const JointSample& sample) const noexcept {
  if (sample.drive_status == JointStatus::kFault) return JointStatus::kFault;
  if (coasted_cycles_ > longest_coast_cycles_) return JointStatus::kStale;
  if (sample.drive_status == JointStatus::kNotReferenced) return JointStatus::kNotReferenced;
  if (fresh_samples_ < settling_samples_) return JointStatus::kStarting;
  return sample.drive_status;
}

/// Motor torque = gear output + friction + armature * acceleration, always. A stuck joint does not
/// accelerate.
double JointEstimator::acceleration_rad_s2() const noexcept {
  return (motor_torque_Nm_ - friction_.friction_torque_Nm() - friction_.output_torque_Nm()) / inertia(joint_);
}

void JointEstimator::write_motion(EstimatedJoint& out) const noexcept {
  out.estimated_position_rad = filter_.position_rad();
  out.estimated_velocity_rad_s = filter_.velocity_rad_s();
  out.estimated_acceleration_rad_s2 = acceleration_rad_s2();
  out.estimated_position_bound_rad = kBoundStds *
                                     root_sum_square(filter_.position_std_rad(), sampling_std_rad());
  out.estimated_velocity_bound_rad_s = kBoundStds * filter_.velocity_std_rad_s();
  out.estimated_acceleration_bound_rad_s2 = kBoundStds *
                                            root_sum_square(filter_.unexplained_std_rad_s2(),
                                                            filter_.unexplained_step_rad_s2(),
                                                            estimation_.current_noise_Nm / inertia(joint_));
}

void JointEstimator::write_torques(EstimatedJoint& out) const noexcept {
  out.measured_motor_torque_Nm = motor_torque_Nm_;
  out.motor_side_torque_Nm = motor_torque_Nm_ -
                             papers_friction_Nm(joint_.coulomb_friction_Nm, filter_.velocity_rad_s());
  out.gear_output_torque_Nm = friction_.output_torque_Nm();
  out.friction_torque_Nm = friction_.friction_torque_Nm();
  out.at_rest = friction_.at_rest();
  out.estimated_temperature_degC = temperature_.temperature_C();
  TorqueBoundInput in;
  in.motor_torque_Nm = motor_torque_Nm_;
  in.friction_std_Nm = root_sum_square(adaptation_.std_Nm(friction_.friction_by_law()),
                                       temperature_.std_Nm(motion_now()));
  in.by_friction = 1.0 / (1.0 + friction_.friction().by_load);
  in.acceleration_rad_s2 = out.estimated_acceleration_rad_s2;
  in.filter_std_rad_s2 = friction_.at_rest() ? 0.0 : filter_.unexplained_std_rad_s2();
  in.filter_step_rad_s2 = friction_.at_rest() ? 0.0 : filter_.unexplained_step_rad_s2();
  in.current_quantisation_Nm = quantisation_Nm_;
  in.rest_distance_Nm = friction_.rest_distance_Nm();
  const TorqueBounds bounds = torque_bounds(joint_, in);
  out.gear_output_torque_bound_Nm = bounds.gear_output_Nm;
  out.friction_torque_bound_Nm = bounds.friction_Nm;
}

/// The motor's side follows what is fast, the twist knows what stands still: each where its variance is
/// small. What the output torque gains, friction loses, or at rest it too.
void JointEstimator::fuse_torsion(const JointSample& sample, double dt_s, EstimatedJoint& out) noexcept {
  if (!joint_.torsion || out.status == JointStatus::kNotReferenced || out.status == JointStatus::kStarting)
    return;
  const GearTorsion& gear = *joint_.torsion;
  const double seen_rad = twist_rad(gear, sample.measured_position_rad, sample.measured_link_position_rad,
                                    sample.motor_angle_rad);
  if (!(std::abs(seen_rad) < kMostTwist_rad)) return;
  if (!out.at_rest && out.status == JointStatus::kOk)
    torsion_zero_.observe(seen_rad, twist_of_rad(gear, out.gear_output_torque_Nm), dt_s);
  const TorsionTorque twist = torsion_torque(gear, seen_rad - torsion_zero_.zero_rad(),
                                             root_sum_square(gear.angle_std_rad, torsion_zero_.std_rad()));
  out.torsion_torque_Nm = twist.torque_Nm;
  const TorsionTorque motor{out.gear_output_torque_Nm, out.gear_output_torque_bound_Nm / kBoundStds};
  const TorsionTorque both = fused(motor, twist);
  out.friction_torque_Nm -= both.torque_Nm - motor.torque_Nm;
  out.gear_output_torque_Nm = both.torque_Nm;
  out.gear_output_torque_bound_Nm = kBoundStds * both.std_Nm;
  out.friction_torque_bound_Nm = std::min(out.friction_torque_bound_Nm, out.gear_output_torque_bound_Nm);
  friction_.learn_output(both.torque_Nm);
}

}  // namespace sprung
