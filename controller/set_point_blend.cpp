#include "controller/set_point_blend.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

constexpr double kFadeSpeed_rad_s = 3.0;   // mean, a quarter of what the joints can do
constexpr double kPeakToMeanOfFade = 1.5;  // of the cubic
/// Largest acceleration of a fading set-point: with the position loop of facts C2, 29.7 Nm s/rad, 1 ms of it
/// is 3 Nm, 1.7 % of the limit. Its speed adds 1.5 Nm, an old torque that fades 2 %: together under 5 %.
constexpr double kFadeAcceleration_rad_s2 = 100.0;
constexpr double kFadeStep = 0.02;
/// Of the limit in a cycle: also what is fed forward comes and goes no faster.
constexpr double kAskedStep = 0.021;

double largest(const JointVector& v) noexcept { return v.size() > 0 ? v.cwiseAbs().maxCoeff() : 0.0; }

}  // namespace

SetPointBlend::SetPointBlend(const std::vector<ActuatorConfig>& actuators) noexcept {
  for (const ActuatorConfig& a : actuators)
    loops_.push_back({a.position_stiffness_Nm_rad, a.position_damping_Nm_s_rad, a.torque_limit_Nm});
  const auto n = static_cast<Eigen::Index>(actuators.size());
  for (JointVector* v : {&offset_.position_rad, &offset_.velocity_rad_s, &torque_Nm_, &feedforward_Nm_,
                         &asked_Nm_, &displacement_.position_rad, &displacement_.velocity_rad_s}) {
    v->setZero(n);
  }
}

void SetPointBlend::start_motion(const SetPoints& from, const SetPoints& to) noexcept {
  offset_.position_rad = from.position_rad - to.position_rad;
  offset_.velocity_rad_s = from.velocity_rad_s - to.velocity_rad_s;
  const double way_rad = largest(offset_.position_rad);
  const double change_rad_s = largest(offset_.velocity_rad_s);
  // Accelerations of the cubic at its start: 6 way / T^2 and 4 change / T.
  motion_.start(std::max({kFade_s, kPeakToMeanOfFade * way_rad / kFadeSpeed_rad_s,
                          std::sqrt(6.0 * way_rad / kFadeAcceleration_rad_s2),
                          4.0 * change_rad_s / kFadeAcceleration_rad_s2}));
}

void SetPointBlend::start_torque(const JointVector& actuator_torque_Nm, double dt_s) noexcept {
  double share = 0.0;
  for (int i = 0; i < torque_Nm_.size(); ++i) {
    const Loop& loop = loops_[i];
    const double known_Nm = loop.stiffness_Nm_rad > 0.0 ? actuator_torque_Nm[i] : 0.0;
    torque_Nm_[i] = std::clamp(known_Nm, -loop.torque_limit_Nm, loop.torque_limit_Nm);
    share = std::max(share, std::abs(torque_Nm_[i]) / loop.torque_limit_Nm);
  }
  displacement_.position_rad.setZero();
  displacement_.velocity_rad_s.setZero();
  asked_Nm_ = torque_Nm_;
  torque_.start(fade_time_s(share, kFadeStep, dt_s));
  displace(dt_s);
}

void SetPointBlend::feed_forward(const JointVector& actuator_torque_Nm) noexcept {
  for (int i = 0; i < feedforward_Nm_.size(); ++i) {
    const Loop& loop = loops_[i];
    const double known_Nm = loop.stiffness_Nm_rad > 0.0 ? actuator_torque_Nm[i] : 0.0;
    feedforward_Nm_[i] = std::clamp(known_Nm, -loop.torque_limit_Nm, loop.torque_limit_Nm);
  }
}

void SetPointBlend::advance(double dt_s) noexcept {
  motion_.advance(dt_s);
  torque_.advance(dt_s);
  displace(dt_s);
}

void SetPointBlend::displace(double dt_s) noexcept {
  for (int i = 0; i < torque_Nm_.size(); ++i) {
    const Loop& loop = loops_[i];
    const double resistance = loop.damping_Nm_s_rad + loop.stiffness_Nm_rad * dt_s;
    double& p = displacement_.position_rad[i];
    double& rate = displacement_.velocity_rad_s[i];
    const double wanted_Nm = torque_.share() * torque_Nm_[i] + (1.0 - torque_.share()) * feedforward_Nm_[i];
    const double most_Nm = kAskedStep * loop.torque_limit_Nm;
    asked_Nm_[i] += std::clamp(wanted_Nm - asked_Nm_[i], -most_Nm, most_Nm);
    rate = resistance > 0.0 ? (asked_Nm_[i] - loop.stiffness_Nm_rad * p) / resistance : 0.0;
    p += rate * dt_s;
  }
}

void SetPointBlend::add_motion(SetPoints& joints) const noexcept {
  joints.position_rad += motion_.share() * offset_.position_rad + motion_.run_s() * offset_.velocity_rad_s;
  joints.velocity_rad_s += motion_.rate_1_s() * offset_.position_rad +
                           motion_.run_rate() * offset_.velocity_rad_s;
}

void SetPointBlend::add_torque(SetPoints& actuators) const noexcept {
  actuators.position_rad += displacement_.position_rad;
  actuators.velocity_rad_s += displacement_.velocity_rad_s;
}

}  // namespace sprung
