#include "planner/adaptive_landing.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

constexpr double kStretchPeakToMean = 1.875;      // of FootMove's speed
constexpr double kStretchAcceleration = 5.7735;   // of FootMove: its peak times duration^2 over way
constexpr double kStretchSpeed_m_s = 1.8;         // what the joints can do with a long leg
constexpr double kStretchShare = 0.7;             // at most, of the fall
constexpr double kLeastWay_m = 0.03;              // to stop in, however short the leg is at contact
constexpr double kLeastForce_N = 10.0;            // on the foot, beyond its bound
constexpr double kSurePush_s = 0.002;             // for this long: contact
constexpr double kLongPush_s = 0.02;              // the same where no ground is expected yet
constexpr double kMostForce_N = 300.0;            // that is believed
constexpr double kMostAcceleration_m_s2 = 100.0;  // added to the planned
constexpr double kLongestStep_s = 0.02;           // of time that one step accounts for

bool beyond_bound(const EstimatedLeg& leg) noexcept {
  return leg.foot_force_N[2] > leg.foot_force_bound_N[2] + kLeastForce_N ||
         std::abs(leg.foot_force_N[0]) > leg.foot_force_bound_N[0] + kLeastForce_N;
}

StiffnessConfig stiffness(const LandingGains& gains) noexcept {
  StiffnessConfig out;
  out.stiffness_N_m = {gains.stiffness_x_N_m, 0.0, gains.stiffness_z_N_m};
  out.damping_N_s_m = {gains.damping_x_N_s_m, 0.0, gains.damping_z_N_s_m};
  out.velocity_feedforward = 1.0;
  return out;
}

/// 0 where it is not known.
double believed_N(double force_N, double least_N) noexcept {
  return std::isfinite(force_N) ? std::clamp(force_N, least_N, kMostForce_N) : 0.0;
}

}  // namespace

AdaptiveLanding::AdaptiveLanding(const RobotConfig& /*robot*/, const LegConfig& /*leg*/,
                                 const PresetConfig& preset)
    : preset_(preset), config_(preset.adaptive_landing), approach_m_s_(0.0) {}

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
  pushed_s_ = beyond_bound(in.measured) ? pushed_s_ + dt_s : 0.0;
  if (stage_ != Stage::kGround && touched(in)) touch_down(in);
  if (stage_ == Stage::kBraking) brake(dt_s);  // before stretch(), whose last cycle has moved the foot
  if (stage_ == Stage::kStretching) stretch();
  if (stage_ == Stage::kGround) yield(dt_s);
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

double AdaptiveLanding::hip_height_m() const noexcept {
  const double left_s = 1e-6 * static_cast<double>(expected_.utime_us - now_us_);
  return preset_.landing_length_m + left_s * (expected_.approach_speed_m_s - 0.5 * kGravity_m_s2 * left_s);
}

double AdaptiveLanding::hip_velocity_m_s() const noexcept {
  const double left_s = 1e-6 * static_cast<double>(expected_.utime_us - now_us_);
  return -(expected_.approach_speed_m_s - kGravity_m_s2 * left_s);
}

void AdaptiveLanding::start(const AdaptiveLandingInput& in) noexcept {
  now_us_ = begun_us_ = in.utime_us;
  foot_ = in.planned;
  const double left_s = 1e-6 * static_cast<double>(expected_.utime_us - now_us_);
  const double duration_s = std::clamp(kStretchShare * left_s, 1e-3, config_.extension_s);
  const double from_m = -foot_.position_m[2];
  const double way_m = std::min(
      kStretchSpeed_m_s * duration_s / kStretchPeakToMean,
      config_.stretch_acceleration_m_s2 * duration_s * duration_s / kStretchAcceleration);
  const double to_m = std::clamp(config_.extended_length_m, from_m - way_m, from_m + way_m);
  move_ = {foot_.position_m, {config_.foot_x_m, 0.0, -to_m}, duration_s};
  stage_ = Stage::kStretching;
  pushed_s_ = 0.0;
}

FootPoint AdaptiveLanding::stretched() const noexcept {
  return move_.at(1e-6 * static_cast<double>(now_us_ - begun_us_));
}

/// Until the foot, braked from now on, would have its approach speed where it is to have it.
void AdaptiveLanding::stretch() noexcept {
  foot_ = stretched();
  approach_m_s_ = -(hip_velocity_m_s() + foot_.velocity_m_s[2]);
  const double way_m = std::max(0.0, hip_height_m() + foot_.position_m[2] - config_.early_m);
  if (approach_m_s_ <= config_.approach_m_s || braking_way_m() < way_m) return;
  stage_ = Stage::kBraking;
  braking_m_s2_ = 0.0;
}

void AdaptiveLanding::set_x(const FootPoint& like) noexcept {
  foot_.position_m[0] = like.position_m[0];
  foot_.velocity_m_s[0] = like.velocity_m_s[0];
  foot_.acceleration_m_s2[0] = like.acceleration_m_s2[0];
}

double AdaptiveLanding::braking_way_m() const noexcept {
  const double excess_m_s = approach_m_s_ - config_.approach_m_s;
  const double most_m_s2 = std::min(config_.braking_m_s2, std::sqrt(config_.braking_jerk_m_s3 * excess_m_s));
  const double takes_s = excess_m_s / most_m_s2 + most_m_s2 / config_.braking_jerk_m_s3;
  return 0.5 * (approach_m_s_ + config_.approach_m_s) * takes_s;
}

void AdaptiveLanding::brake(double dt_s) noexcept {
  set_x(stretched());
  const double excess_m_s = std::max(0.0, approach_m_s_ - config_.approach_m_s);
  const double ending_m_s2 = std::sqrt(2.0 * config_.braking_jerk_m_s3 * excess_m_s);
  const double step_m_s2 = config_.braking_jerk_m_s3 * dt_s;
  braking_m_s2_ = std::clamp(std::min(config_.braking_m_s2, ending_m_s2), braking_m_s2_ - step_m_s2,
                             braking_m_s2_ + step_m_s2);
  approach_m_s_ -= std::min(excess_m_s, braking_m_s2_ * dt_s);
  const double wanted_m_s = -approach_m_s_ - hip_velocity_m_s();
  const bool fastest = wanted_m_s > config_.fastest_m_s;
  const bool shortest = -foot_.position_m[2] <= config_.shortest_m + kLeastWay_m;
  double& velocity = foot_.velocity_m_s[2];
  velocity = shortest ? 0.0 : std::min(wanted_m_s, config_.fastest_m_s);
  foot_.acceleration_m_s2[2] = fastest || shortest ? 0.0 : kGravity_m_s2 + braking_m_s2_;
  foot_.position_m[2] += velocity * dt_s;
}

/// The planner's contact is not asked: it takes the force as vertical (a foot that sticks while its leg
/// yields is pushed along the shank, too), and a leg whose rotors reverse can look like a landed one. So the
/// force itself is looked at, and believed at once where the ground is near.
bool AdaptiveLanding::touched(const AdaptiveLandingInput& in) const noexcept {
  const double over_ground_m = hip_height_m() + in.measured.estimated_foot_in_hip_m[2];
  const bool near = over_ground_m < config_.timing_s * std::max(0.0, -hip_velocity_m_s());
  return pushed_s_ >= (near ? kSurePush_s : kLongPush_s);
}

/// From here on foot and ground are one: the leg gets shorter as fast as the body falls.
void AdaptiveLanding::touch_down(const AdaptiveLandingInput& in) noexcept {
  stage_ = Stage::kGround;
  ground_s_ = 0.0;
  set_x({foot_.position_m, {}, {}});
  const double measured_m = in.measured.estimated_foot_in_hip_m[2];
  if (measured_m < 0.0) foot_.position_m[2] = measured_m;  // and not NaN
  const double speed_m_s = std::max(0.0, -hip_velocity_m_s());
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
  const double x_N = believed_N(measured_.foot_force_N[0], -kMostForce_N);
  const double z_N = believed_N(measured_.foot_force_N[2], 0.0);
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
