#include "tools/experiments/foot_return_script.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

using namespace foot_return;

constexpr double kPi = 3.14159265358979323846;
constexpr double kEnabled_s = 0.3;
constexpr double kReach_s = 0.8;  // to the leg's length, the first time
constexpr double kReturn_s = 0.4;

}  // namespace

std::vector<FootPull> eight_by_five(double first_force_N, double step_N) {
  std::vector<FootPull> out;
  for (int direction = 0; direction < 8; ++direction) {
    for (int force = 0; force < 5; ++force)
      out.push_back({0.25 * kPi * direction, first_force_N + step_N * force});
  }
  return out;
}

std::vector<SimControl> hand(const FootReturnScript& script, double cycle_s) {
  std::vector<SimControl> out;
  for (std::size_t i = 0; i < script.pulls.size(); ++i) {
    const FootPull& pull = script.pulls[i];
    SimControl control;
    control.kind = SimControlKind::kWrench;
    control.actuator = 0;  // the foot of this leg
    control.apply_at_seq = std::llround((kFirst_s + kPeriod_s * static_cast<double>(i) + kPull_s) / cycle_s);
    control.wrench = {pull.force_N * std::cos(pull.direction_rad), 0,
                      pull.force_N * std::sin(pull.direction_rad)};
    control.value = kGrow_s;
    control.duration_s = kGrow_s + kHold_s;
    out.push_back(control);
  }
  return out;
}

void HangingLeg::command(const JointState& in, LegCommand& out) noexcept {
  if (began_us_ < 0) began_us_ = in.stamp.utime_us;
  out.stamp = in.stamp;
  out.used_joint_state_seq = in.stamp.seq;
  for (DesiredLeg& leg : out.legs) {
    leg = DesiredLeg{};
    follow(in, leg);
  }
}

void HangingLeg::follow(const JointState& in, DesiredLeg& leg) noexcept {
  const double time_s = 1e-6 * static_cast<double>(in.stamp.utime_us - began_us_);
  const Vec3 measured_m = in.legs.front().estimated_foot_in_hip_m;
  leg.phase = LegPhase::kStand;
  leg.control_mode = ControlMode::kPosition;
  leg.desired_foot_in_hip_m = measured_m;
  if (time_s < kEnabled_s) return;
  const int last = static_cast<int>(script_.pulls.size()) - 1;
  const int pull =
      time_s < kFirst_s ? -1 : std::min(static_cast<int>((time_s - kFirst_s) / kPeriod_s + 1e-6), last);
  const double began_s = pull < 0 ? kEnabled_s : kFirst_s + kPeriod_s * pull;
  const Vec3 rest_m{0.0, 0.0, -script_.leg_length_m};
  if (pull != move_of_pull_) move_ = {measured_m, rest_m, pull < 0 ? kReach_s : kReturn_s};
  move_of_pull_ = pull;
  const FootPoint foot = move_.at(time_s - began_s);
  leg.desired_foot_in_hip_m = foot.position_m;
  leg.desired_foot_velocity_m_s = foot.velocity_m_s;
  leg.desired_foot_acceleration_m_s2 = foot.acceleration_m_s2;
  if (pull < 0 || time_s - began_s < kCentre_s - 1e-6) return;
  leg.control_mode = ControlMode::kCompliance;
  leg.stiffness_N_m = {script_.stiffness_N_m, 0.0, script_.stiffness_N_m};
  leg.damping_N_s_m = {script_.damping_N_s_m, 0.0, script_.damping_N_s_m};
  leg.velocity_feedforward = velocity_feedforward_;
  leg.friction_compensation = script_.friction_compensation;
}

}  // namespace sprung
