#include "tools/lab/gait/step_score.h"

#include <algorithm>
#include <cmath>

#include "planner/gait/body_frame.h"

namespace sprung {
namespace {

constexpr double kTouch_N = 5.0;

double length(const Vec3& v) noexcept { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

bool swings(LegPhase phase) noexcept { return phase == LegPhase::kSwing || phase == LegPhase::kPreStance; }

}  // namespace

StepScore::StepScore(const RobotConfig& robot, double floor_m) : cycle_s_(robot.cycle_s), floor_m_(floor_m) {
  for (const LegConfig& leg : robot.legs) {
    legs_.emplace_back();
    legs_.back().knee = static_cast<std::size_t>(leg.joints.back());
  }
}

void StepScore::add(const StepSigns& now) {
  for (std::size_t i = 0; i < legs_.size(); ++i) add_leg(i, now);
}

void StepScore::add_leg(std::size_t i, const StepSigns& now) {
  Leg& leg = legs_[i];
  const TrueLeg& truth = now.truth.legs[i];
  const bool touches = length(truth.true_contact_force_N) > kTouch_N;
  const bool in_swing = swings(now.motion.legs[i].phase);
  if (in_swing && !touches) {
    leg.in_air = true;
    const Vec3& wanted = now.command.legs[i].desired_foot_in_hip_m;
    const Vec3& foot = now.joints.legs[i].estimated_foot_in_hip_m;
    const double error_m = length({wanted[0] - foot[0], wanted[1] - foot[1], wanted[2] - foot[2]});
    squares_m2_ += error_m * error_m;
    swing_cycles_ += 1.0;
  }
  if (leg.in_air && touches && leg.cycles_left == 0) touch_down(i, now);
  if (leg.cycles_left == 0) return;
  leg.impact.force_N = std::max(leg.impact.force_N, length(truth.true_contact_force_N));
  leg.impact.knee_Nm = std::max(leg.impact.knee_Nm,
                                std::abs(now.truth.joints[leg.knee].true_gear_output_torque_Nm));
  if (--leg.cycles_left == 0) touchdowns_.push_back(leg.impact);
}

void StepScore::touch_down(std::size_t i, const StepSigns& now) {
  Leg& leg = legs_[i];
  leg.in_air = false;
  leg.cycles_left = std::max(1, static_cast<int>(std::lround(kImpact_s / cycle_s_)));
  leg.impact = {};
  leg.impact.leg = i;
  leg.impact.time_s = static_cast<double>(now.truth.stamp.seq) * cycle_s_;
  leg.impact.ground_error_m = now.truth.legs[i].true_ground_height_m - floor_m_;
}

double StepScore::swing_rms_m() const noexcept {
  return swing_cycles_ > 0.0 ? std::sqrt(squares_m2_ / swing_cycles_) : kNaN;
}

TouchdownPeaks touchdown_peaks(const std::vector<Touchdown>& touchdowns) noexcept {
  TouchdownPeaks out;
  if (touchdowns.empty()) return out;
  out = {0.0, 0.0, 0.0, 0.0};
  const auto count = static_cast<double>(touchdowns.size());
  for (const Touchdown& t : touchdowns) {
    out.worst_N = std::max(out.worst_N, t.force_N);
    out.worst_Nm = std::max(out.worst_Nm, t.knee_Nm);
    out.mean_N += t.force_N / count;
    out.mean_Nm += t.knee_Nm / count;
  }
  return out;
}

void TravelScore::add(const SimTruth& truth, double dt_s) {
  const double yaw_rad = attitude(truth.base_quaternion_wxyz).yaw_rad;
  if (!began_) {
    began_ = true;
    from_m_ = truth.base_in_world_m;
    last_yaw_rad_ = yaw_rad;
  } else {
    time_s_ += dt_s;
  }
  at_m_ = truth.base_in_world_m;
  yaw_rad_ += wrapped_rad(yaw_rad - last_yaw_rad_);
  last_yaw_rad_ = yaw_rad;
}

double TravelScore::distance_m() const noexcept {
  return std::hypot(at_m_[0] - from_m_[0], at_m_[1] - from_m_[1]);
}

double TravelScore::speed_m_s() const noexcept { return time_s_ > 0.0 ? distance_m() / time_s_ : kNaN; }

}  // namespace sprung
