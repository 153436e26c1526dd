#include "tools/lab/estimation/estimator_score.h"

#include <cmath>

namespace sprung {
namespace {

constexpr double kOnGround_N = 1.0;               // true vertical force that counts as ground contact
constexpr std::int64_t kLeastFlight_us = 30'000;  // shorter hops off the ground are no flight

bool stood_for(const EstimatedJoint& joint) {
  return joint.status == JointStatus::kOk || joint.status == JointStatus::kSaturated;
}

double ground_force_N(const SimTruth& truth) {
  double force_N = 0.0;
  for (const TrueLeg& leg : truth.legs) force_N += leg.true_contact_force_N[2];
  return force_N;
}

}  // namespace

void TorqueScore::add(const EstimatedJoint& estimated, const TrueJoint& truth) {
  const double true_Nm = truth.true_gear_output_torque_Nm;
  const double error_Nm = estimated.gear_output_torque_Nm - true_Nm;
  if (!stood_for(estimated) || !std::isfinite(error_Nm)) return;
  const double papers_Nm = estimated.motor_side_torque_Nm - true_Nm;
  ++samples_;
  squares_Nm2_ += error_Nm * error_Nm;
  papers_squares_Nm2_ += papers_Nm * papers_Nm;
  covered_ += std::abs(error_Nm) <= estimated.gear_output_torque_bound_Nm ? 1.0 : 0.0;
  bounds_Nm_ += estimated.gear_output_torque_bound_Nm;
}

void TorqueScore::add(const TorqueScore& other) {
  samples_ += other.samples_;
  squares_Nm2_ += other.squares_Nm2_;
  papers_squares_Nm2_ += other.papers_squares_Nm2_;
  covered_ += other.covered_;
  bounds_Nm_ += other.bounds_Nm_;
}

double TorqueScore::mean(double sum) const {
  return samples_ > 0 ? sum / static_cast<double>(samples_) : kNaN;
}

double TorqueScore::rms_Nm() const { return std::sqrt(mean(squares_Nm2_)); }
double TorqueScore::papers_rms_Nm() const { return std::sqrt(mean(papers_squares_Nm2_)); }
double TorqueScore::covered() const { return mean(covered_); }
double TorqueScore::mean_bound_Nm() const { return mean(bounds_Nm_); }

JumpWindow::Part JumpWindow::add(const MotionState& motion, const SimTruth& truth) {
  const std::int64_t now_us = now_us_ = truth.stamp.utime_us;
  const bool thrust_begins = motion.state == MotionPhase::kThrust && last_phase_ != MotionPhase::kThrust;
  const bool on_ground = ground_force_N(truth) > kOnGround_N;
  last_phase_ = motion.state;
  if (thrust_begins && part_ == Part::kOther) {
    part_ = Part::kPushOff;
  } else if (part_ == Part::kPushOff && !on_ground) {
    part_ = Part::kFlight;
    since_us_ = now_us;
  } else if (part_ == Part::kFlight && on_ground) {
    part_ = now_us - since_us_ >= kLeastFlight_us ? Part::kLanding : Part::kPushOff;
    since_us_ = now_us;
  } else if (part_ == Part::kLanding && now_us - since_us_ > std::llround(kLanding_s * 1e6)) {
    part_ = Part::kOther;
    complete_ = true;
  }
  return part_;
}

}  // namespace sprung
