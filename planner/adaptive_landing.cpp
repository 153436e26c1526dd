#include "planner/adaptive_landing.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

constexpr double kLeastForce_N = 10.0;            // on the foot, beyond its bound
constexpr double kSurePush_s = 0.002;             // for this long: contact
constexpr double kLongPush_s = 0.02;              // the same where no ground is expected yet
constexpr double kAirForce_s = 0.02;              // in which the force felt in the air is learned
constexpr double kRisenShare = 0.25;              // of the bound, that may change faster than that
constexpr double kHardShare = 2.0;                // of the bound, for contact where none is expected yet
constexpr double kMostForce_N = 300.0;            // that is believed
constexpr double kVagueForce_N = 100.0;           // of a bound with which a landing's force tells nothing
constexpr double kMostAcceleration_m_s2 = 100.0;  // added to the planned

bool pushed(const EstimatedLeg& leg, const Vec3& none_N, double bound_share) noexcept {
  const auto least_N = [&](std::size_t axis) {
    return bound_share * leg.foot_force_bound_N[axis] + kLeastForce_N;
  };
  return leg.foot_force_N[2] - none_N[2] > least_N(2) ||
         std::abs(leg.foot_force_N[0] - none_N[0]) > least_N(0);
}

StiffnessConfig stiffness(const LandingGains& gains) noexcept {
  StiffnessConfig out;
  out.stiffness_N_m = {gains.stiffness_x_N_m, 0.0, gains.stiffness_z_N_m};
  out.damping_N_s_m = {gains.damping_x_N_s_m, 0.0, gains.damping_z_N_s_m};
  out.velocity_feedforward = 1.0;
  return out;
}

/// Between what is planned and what is measured, as far as its bound lets that be told from the plan. A law
/// of friction that is another gear's is 300 N off: whoever believed that would let the leg fold.
double believed_N(double planned_N, double measured_N, double bound_N, double least_N) noexcept {
  if (!std::isfinite(measured_N) || !std::isfinite(bound_N)) return planned_N;
  const double ratio = bound_N / kVagueForce_N;
  const double share = 1.0 / (1.0 + ratio * ratio);
  return planned_N + share * (std::clamp(measured_N, least_N, kMostForce_N) - planned_N);
}

}  // namespace

AdaptiveLanding::AdaptiveLanding(const RobotConfig& robot, const LegConfig& leg, const PresetConfig& preset)
    : preset_(preset),
      config_(preset.adaptive_landing),
      motors_(robot, leg),
      fall_(config_, preset.landing_length_m) {}

void AdaptiveLanding::begin(const ExpectedTouchdown& expected) noexcept {
  expected_ = expected;
  stage_ = Stage::kBefore;
}

AdaptiveLandingOutput AdaptiveLanding::step(const AdaptiveLandingInput& in) noexcept {
  if (config_.extended_length_m <= 0.0) return as_hybrid(in);
  if (stage_ == Stage::kBefore) start(in);
  const double dt_s = std::clamp(1e-6 * static_cast<double>(in.utime_us - now_us_), 0.0, kLongestStep_s);
  now_us_ = in.utime_us;
  measured_ = in.measured;
  if (stage_ == Stage::kAir) {
    feel(dt_s);
    fall_.step(now_us_);
    if (touched(in)) touch_down(in);
  }
  if (stage_ == Stage::kGround) {
    yield(dt_s);
  } else {
    foot_ = fall_.foot();
  }
  return output();
}

AdaptiveLandingOutput AdaptiveLanding::as_hybrid(const AdaptiveLandingInput& in) const noexcept {
  DesiredLeg leg;
  set_control(in.progress, preset_, leg);
  AdaptiveLandingOutput out;
  out.desired = in.planned;
  out.control_mode = leg.control_mode;
  out.gains = {leg.stiffness_N_m, leg.damping_N_s_m, leg.velocity_feedforward};
  out.feedforward_force_N = leg.feedforward_force_N;
  out.friction_compensation = leg.friction_compensation;
  out.inertia_compensation = leg.inertia_compensation;
  return out;
}

void AdaptiveLanding::start(const AdaptiveLandingInput& in) noexcept {
  now_us_ = in.utime_us;
  fall_.begin(now_us_, in.planned, expected_);
  fall_.set_braking(motors_.most_braking_m_s2(fall_, config_.braking_m_s2));
  stage_ = Stage::kAir;
  pushed_s_ = pushed_hard_s_ = risen_s_ = 0.0;
  air_force_N_ = {};
}

/// In the air nothing pushes: what is felt there is the error of friction's law, which changes with the
/// speed, not at once as the ground's force does.
void AdaptiveLanding::feel(double dt_s) noexcept {
  pushed_s_ = pushed(measured_, {}, 1.0) ? pushed_s_ + dt_s : 0.0;
  pushed_hard_s_ = pushed(measured_, {}, kHardShare) ? pushed_hard_s_ + dt_s : 0.0;
  risen_s_ = pushed(measured_, air_force_N_, kRisenShare) ? risen_s_ + dt_s : 0.0;
  const double share = dt_s / (dt_s + kAirForce_s);
  for (const std::size_t axis : {0, 2}) {
    const double error_N = measured_.foot_force_N[axis] - air_force_N_[axis];
    if (std::isfinite(error_N)) air_force_N_[axis] += share * error_N;
  }
}

/// The planner's contact is not asked: it takes the force as vertical (a foot that sticks while its leg
/// yields is pushed along the shank, too), and a leg whose rotors reverse can look like a landed one. So the
/// force itself is looked at, and believed at once where the ground is near.
bool AdaptiveLanding::touched(const AdaptiveLandingInput& in) const noexcept {
  const double over_ground_m = fall_.hip_height_m() + in.measured.estimated_foot_in_hip_m[2];
  const bool near = over_ground_m < config_.timing_s * std::max(0.0, -fall_.hip_velocity_m_s());
  if (!near) return pushed_hard_s_ >= kLongPush_s;
  if (measured_.foot_force_bound_N[2] > kVagueForce_N && over_ground_m <= 0.0) return true;
  return pushed_s_ >= kSurePush_s || risen_s_ >= kSurePush_s;
}

/// From here on foot and ground are one: the leg gets shorter as fast as the body falls.
void AdaptiveLanding::touch_down(const AdaptiveLandingInput& in) noexcept {
  stage_ = Stage::kGround;
  ground_s_ = 0.0;
  foot_ = {foot_.position_m, {}, {}};
  const double measured_m = in.measured.estimated_foot_in_hip_m[2];
  if (measured_m < 0.0) foot_.position_m[2] = measured_m;  // and not NaN
  const double speed_m_s = std::max(0.0, -fall_.hip_velocity_m_s());
  foot_.velocity_m_s[2] = speed_m_s;
  const double lost_m = 0.5 * speed_m_s * config_.force_rise_s;  // while the force rises
  const double way_m = std::max(kLeastWay_m, -foot_.position_m[2] - lost_m - config_.shortest_m);
  stopping_m_s2_ = 0.5 * speed_m_s * speed_m_s / way_m;
}

void AdaptiveLanding::yield(double dt_s) noexcept {
  ground_s_ += dt_s;
  double& velocity = foot_.velocity_m_s[2];
  foot_.acceleration_m_s2[2] = velocity > 0.0 ? -force_rise() * stopping_m_s2_ : 0.0;
  velocity = std::max(0.0, velocity + foot_.acceleration_m_s2[2] * dt_s);
  foot_.position_m[2] += velocity * dt_s;
}

double AdaptiveLanding::force_rise() const noexcept {
  return std::min(1.0, ground_s_ / std::max(config_.force_rise_s, 1e-6));
}

AdaptiveLandingOutput AdaptiveLanding::output() const noexcept {
  AdaptiveLandingOutput out;
  out.desired = foot_;
  out.control_mode = ControlMode::kCompliance;
  out.inertia_compensation = config_.inertia_compensation;
  if (stage_ == Stage::kGround) {
    ground(out);
  } else {
    air(out);
  }
  return out;
}

void AdaptiveLanding::air(AdaptiveLandingOutput& out) const noexcept {
  out.gains = stiffness(config_.air);
  out.friction_compensation = config_.friction_compensation;
  move_as_mass(0, config_.air.mass_x_kg, 0.0, 1.0, out);
  move_as_mass(2, config_.air.mass_z_kg, 0.0, 1.0, out);
}

void AdaptiveLanding::ground(AdaptiveLandingOutput& out) const noexcept {
  out.gains = stiffness(config_.ground);
  out.friction_compensation = config_.ground_friction_compensation;
  const double planned_N = force_rise() * config_.body_mass_kg * (kGravity_m_s2 - foot_.acceleration_m_s2[2]);
  const double share = std::max(0.0, 1.0 - ground_s_ / std::max(config_.mass_s, 1e-6));
  const Vec3& felt_N = measured_.foot_force_N;
  const Vec3& bound_N = measured_.foot_force_bound_N;
  const double x_N = believed_N(0.0, felt_N[0], bound_N[0], -kMostForce_N);
  const double z_N = believed_N(planned_N, felt_N[2], bound_N[2], 0.0);
  move_as_mass(0, config_.ground.mass_x_kg, x_N, share, out);
  move_as_mass(2, config_.ground.mass_z_kg, z_N - planned_N, share, out);
  const double measured_share = config_.ground.mass_z_kg > 0.0 ? share : 0.0;
  out.feedforward_force_N[2] = (1.0 - measured_share) * planned_N +
                               measured_share * config_.measured_force_share * z_N;
}

void AdaptiveLanding::move_as_mass(std::size_t axis, double mass_kg, double force_N, double share,
                                   AdaptiveLandingOutput& out) const noexcept {
  if (mass_kg <= 0.0) return;
  double& stiffness_N_m = out.gains.stiffness_N_m[axis];
  double& damping_N_s_m = out.gains.damping_N_s_m[axis];
  const double error_m = foot_.position_m[axis] - measured_.estimated_foot_in_hip_m[axis];
  const double slip_m_s = foot_.velocity_m_s[axis] - measured_.estimated_foot_velocity_m_s[axis];
  const double spring_N = stiffness_N_m * error_m + damping_N_s_m * slip_m_s;
  const double all_N = force_N + (std::isfinite(spring_N) ? spring_N : 0.0);
  out.desired.acceleration_m_s2[axis] += share * std::clamp(all_N / mass_kg, -kMostAcceleration_m_s2,
                                                            kMostAcceleration_m_s2);
  stiffness_N_m *= 1.0 - share;
  damping_N_s_m *= 1.0 - share;
}

}  // namespace sprung
