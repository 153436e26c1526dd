#include "tools/lab/estimation/stepping_leg.h"

#include <algorithm>
#include <cmath>

#include "simulation/hash_noise.h"

namespace sprung {

namespace {

constexpr double kFirstLift_s = 1.0;
constexpr double kNoFloor_m = -1.0;
/// Of the desired descent: speed within 40 ms, as a swing that is planned to touch down fast.
constexpr double kSpeedUp_s = 0.04;
constexpr double kBraking_m_s2 = 20.0;

enum Quantity { kSpeedClass, kSpeed, kFloor, kFootX, kWaitAbove, kWaitBelow, kLiftTime, kHasFloor };

bool all_enabled(const JointState& in) noexcept {
  return std::all_of(in.joints.begin(), in.joints.end(), [](const EstimatedJoint& joint) {
    return joint.drive_enabled && joint.status != JointStatus::kStarting;
  });
}

bool any_contact(const JointState& in) noexcept {
  return std::any_of(in.legs.begin(), in.legs.end(), [](const EstimatedLeg& leg) { return leg.contact; });
}

}  // namespace

double SteppingLeg::draw(int quantity, double low, double high) const noexcept {
  const std::uint64_t bits = sim::mix_bits(
      sim::mix_bits(sim::mix_bits(script_.seed) ^ static_cast<std::uint64_t>(step_ + 1)) ^
      static_cast<std::uint64_t>(quantity));
  return low + (high - low) * static_cast<double>(bits >> 11) / 9007199254740992.0;  // 2^53
}

/// The three classes of approach, in turn by chance. The drives' position loops do not reach a fast descent
/// in full.
double SteppingLeg::drawn_speed_m_s() const noexcept {
  const double approach = draw(kSpeedClass, 0.0, 3.0);
  if (approach < 1.0) return draw(kSpeed, 0.08, 0.3);
  return approach < 2.0 ? draw(kSpeed, 0.35, 0.95) : draw(kSpeed, 1.1, 1.6);
}

double SteppingLeg::floor_height_m() const noexcept {
  const bool without = draw(kHasFloor, 0.0, 1.0) < script_.share_without_floor;
  return without ? kNoFloor_m : draw(kFloor, -script_.floor_spread_m, script_.floor_spread_m);
}

void SteppingLeg::command(const JointState& in, LegCommand& out) noexcept {
  const double dt_s = last_us_ < 0 ? 0.0 : 1e-6 * static_cast<double>(in.stamp.utime_us - last_us_);
  last_us_ = in.stamp.utime_us;
  step_begins_ = false;
  in_phase_s_ += dt_s;
  if (phase_ == Phase::kDescending) descend(dt_s);
  follow(in);
  out.stamp = in.stamp;
  out.used_joint_state_seq = in.stamp.seq;
  for (DesiredLeg& leg : out.legs) {
    leg = DesiredLeg{};
    leg.phase = LegPhase::kSwing;
    leg.control_mode = ControlMode::kPosition;
    leg.desired_foot_in_hip_m = foot_.position_m;
    leg.desired_foot_velocity_m_s = foot_.velocity_m_s;
    leg.desired_foot_acceleration_m_s2 = foot_.acceleration_m_s2;
  }
}

void SteppingLeg::follow(const JointState& in) noexcept {
  switch (phase_) {
    case Phase::kEnabling:
      foot_ = {in.legs.front().estimated_foot_in_hip_m, {}, {}};
      if (all_enabled(in)) start_lift(kFirstLift_s);
      break;
    case Phase::kLifting:
      foot_ = lift_.at(in_phase_s_);
      if (in_phase_s_ >= lift_.duration_s) start_step();
      break;
    case Phase::kWaitingAbove:
      if (in_phase_s_ >= draw(kWaitAbove, 0.05, 0.2)) enter(Phase::kDescending);
      break;
    case Phase::kDescending:
      if (any_contact(in) || -foot_.position_m[2] >= script_.lowest_m) enter(Phase::kWaitingBelow);
      break;
    case Phase::kWaitingBelow:
      if (in_phase_s_ >= draw(kWaitBelow, 0.15, 0.4)) start_lift(draw(kLiftTime, 0.3, 0.6));
      break;
  }
}

void SteppingLeg::descend(double dt_s) noexcept {
  const double speed_m_s = drawn_speed_m_s();
  const double left_m = std::max(0.0, script_.lowest_m + foot_.position_m[2]);
  constexpr double kCreep_m_s = 0.02;  // so that the lowest point is reached
  const double braked_m_s = kCreep_m_s + std::sqrt(2.0 * kBraking_m_s2 * left_m);
  const double wanted_m_s = std::min({speed_m_s, braked_m_s, speed_m_s * in_phase_s_ / kSpeedUp_s});
  foot_.acceleration_m_s2 = {};
  foot_.velocity_m_s = {0.0, 0.0, -wanted_m_s};
  foot_.position_m[2] -= wanted_m_s * dt_s;
}

void SteppingLeg::enter(Phase phase) noexcept {
  phase_ = phase;
  in_phase_s_ = 0.0;
  foot_.velocity_m_s = foot_.acceleration_m_s2 = {};
}

void SteppingLeg::start_lift(double duration_s) noexcept {
  enter(Phase::kLifting);
  ++step_;
  const double x_m = draw(kFootX, -script_.foot_spread_m, script_.foot_spread_m);
  lift_ = {foot_.position_m, {x_m, 0.0, -script_.top_m}, duration_s};
}

void SteppingLeg::start_step() noexcept {
  enter(Phase::kWaitingAbove);
  step_begins_ = !done();
}

}  // namespace sprung
