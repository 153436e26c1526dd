#include "planner/gait/leg_step.h"

#include <algorithm>

namespace sprung {
namespace {

constexpr double kStumbleFrom = 0.2;   // share of the swing: before, the foot may still be leaving
constexpr double kStumbleTo = 0.6;     // later it is on its way down: then contact is the ground
constexpr double kLateAfter_s = 0.02;  // contact is felt a little after it is made
/// A swing that accelerates hard looks like contact for some 10 ms (docs/locomotion.md, "What is weak").
constexpr double kStumbleFor_s = 0.02;
constexpr double kLeastHeight_m = 0.05;     // of the hip over a standing foot; lower, nothing walks
constexpr double kClearance_m = 0.02;       // that a stumble adds to the lift
constexpr double kBack = 1.0;               // of a late foot, for each metre down
constexpr double kClearanceRate_m_s = 0.2;  // so that the foot is not jerked

/// Of the centre of a standing foot's ball, as the body sees it. The leg turns about where the ball touches
/// the ground, and so takes the centre along: radius over height of the hip as fast as the hip.
Eigen::Vector3d standing_m_s(const StepPlan& plan, const Eigen::Vector3d& foot_m) noexcept {
  Eigen::Vector3d out = plan.ground_m_s(foot_m);
  const double height_m = std::max(kLeastHeight_m, -foot_m.z());
  out.head<2>() *= height_m / (height_m + plan.foot_radius_m);
  return out;
}

}  // namespace

void LegStep::enter(LegPhase phase) noexcept {
  phase_ = phase;
  in_phase_s_ = 0.0;
}

void LegStep::note(LegEvent event) noexcept {
  last_event_ = event;
  ++counts_[static_cast<std::size_t>(event)];
}

void LegStep::stand(const Eigen::Vector3d& foot_m, double since_s) noexcept {
  enter(LegPhase::kStance);
  in_phase_s_ = since_s;
  wanted_m_ = foot_m;
  wanted_m_s_.setZero();
  wanted_m_s2_.setZero();
  gave_up_ = false;
}

void LegStep::lift(const Eigen::Vector3d& foot_m) noexcept {
  enter(LegPhase::kSwing);
  in_swing_s_ = 0.0;
  extra_lift_m_ = 0.0;
  stumbled_ = false;
  held_up_s_ = 0.0;
  gave_up_ = false;
  riser_.forget();
  from_m_ = left_m_ = foot_m;
  stretch_at_lift_m_ = wanted_m_ - foot_m;
}

bool LegStep::step(const StepPlan& plan, const Eigen::Vector3d& foot_m, const Eigen::Vector3d& foothold_m,
                   bool contact) noexcept {
  in_phase_s_ += plan.dt_s;
  riser_.carry(plan.ground_m_s(riser_.held_m()), plan.dt_s);
  if (stands()) {
    wanted_m_s_ = standing_m_s(plan, wanted_m_);
    wanted_m_ += wanted_m_s_ * plan.dt_s;
    return false;
  }
  if (in_swing_s_ == 0.0) {
    control_ = plan.control;
    ground_z_m_ = foothold_m.z();
  } else {
    ground_z_m_ += plan.sunk_m;
    from_m_.z() += plan.sunk_m;
    riser_.sink(plan.sunk_m);
  }
  left_m_ += plan.ground_m_s(left_m_) * plan.dt_s;
  in_swing_s_ += plan.dt_s;
  const Eigen::Vector3d goal_m = riser_.foothold_m(foothold_m);
  further_m_ = (goal_m - foothold_m).head<2>();
  swing(plan, goal_m);
  look(plan, contact);
  mind_riser(plan, foot_m, foothold_m);
  if (!landed(plan, contact)) return false;
  const bool gave_up = gave_up_;
  stand(foot_m);
  wanted_m_s_ = standing_m_s(plan, foot_m);
  gave_up_ = gave_up;
  return true;
}

void LegStep::swing(const StepPlan& plan, const Eigen::Vector3d& foothold_m) noexcept {
  SwingPath path;
  path.from_m = from_m_;
  path.to_m = {foothold_m.x(), foothold_m.y(), ground_z_m_};
  path.ground_m_s = -plan.body_m_s;
  path.duration_s = plan.swing_s;
  path.lift_m = plan.gait->lift_m + extra_lift_m_;
  if (riser_.goes_over()) {
    path.lift_m = std::max(path.lift_m, riser_.top_m(ground_z_m_) - 0.5 * (from_m_.z() + ground_z_m_));
    path.aside_m = riser_.aside_m();
  }
  // Whoever waits for contact comes down slowly; plain hybrid trusts its clock.
  const bool waits = control_ == GaitControl::kAdaptive;
  path.approach_s = waits ? plan.gait->pre_stance * plan.swing_s : 0.0;
  path.approach_m_s = waits ? plan.approach_m_s() : 0.0;
  const SwingPoint point = path.at(in_swing_s_);
  wanted_m_ = point.position_m;
  wanted_m_s_ = point.velocity_m_s;
  wanted_m_s2_ = point.acceleration_m_s2;
  const double over_s = in_swing_s_ - plan.swing_s;
  if (waits && over_s > 0.0) search_back(plan, over_s);
  if (!waits && over_s > 0.0 && control_ != GaitControl::kHybrid) {
    wanted_m_.z() -= plan.approach_m_s() * over_s;
    wanted_m_s_.z() = -plan.approach_m_s();
  }
}

/// A foot that is held up begins its swing anew.
void LegStep::mind_riser(const StepPlan& plan, const Eigen::Vector3d& foot_m,
                         const Eigen::Vector3d& foothold_m) noexcept {
  const bool stands = plan.bears && phase_ == LegPhase::kPreStance;
  if (!plan.may_wait || stands || control_ != GaitControl::kAdaptive || in_swing_s_ >= plan.swing_s) return;
  const Eigen::Vector2d way_m = (riser_.foothold_m(foothold_m) - left_m_).head<2>();
  if (!riser_.step(way_m, wanted_m_, foot_m, plan.dt_s)) return;
  note(LegEvent::kStumble);
  enter(LegPhase::kSwing);
  from_m_ = foot_m;
  in_swing_s_ = plan.dt_s;
  held_up_s_ = 0.0;
  swing(plan, riser_.foothold_m(foothold_m));
}

void LegStep::search_back(const StepPlan& plan, double over_s) noexcept {
  const Eigen::Vector2d way_m = plan.ahead_m + further_m_;
  const double ahead_m = way_m.norm(), back_m_s = kBack * plan.approach_m_s();
  if (!(ahead_m > 0.0)) return;
  const double back_m = std::min(back_m_s * over_s, ahead_m);
  wanted_m_.head<2>() -= way_m * (back_m / ahead_m);
  if (back_m < ahead_m) wanted_m_s_.head<2>() -= way_m * (back_m_s / ahead_m);
}

void LegStep::look(const StepPlan& plan, bool contact) noexcept {
  const double share = in_swing_s_ / plan.swing_s;
  if (phase_ == LegPhase::kSwing && share >= 1.0 - plan.gait->pre_stance) enter(LegPhase::kPreStance);
  const bool held_up = contact && share > kStumbleFrom && share < kStumbleTo;
  held_up_s_ = held_up ? held_up_s_ + plan.dt_s : 0.0;
  if (held_up_s_ >= kStumbleFor_s && !stumbled_) {
    note(LegEvent::kStumble);
    stumbled_ = true;
  }
  if (stumbled_) extra_lift_m_ = std::min(kClearance_m, extra_lift_m_ + kClearanceRate_m_s * plan.dt_s);
  const double late_s = in_swing_s_ - plan.swing_s - kLateAfter_s;
  const bool just_late = late_s >= 0.0 && late_s < plan.dt_s;
  if (just_late && !contact && control_ != GaitControl::kHybrid) note(LegEvent::kLateContact);
}

bool LegStep::landed(const StepPlan& plan, bool contact) noexcept {
  const double share = in_swing_s_ / plan.swing_s;
  if (control_ == GaitControl::kHybrid) return share >= 1.0;
  const bool on_edge = riser_.on_edge() && share < 1.0 && !plan.bears;
  const bool ground = share >= kStumbleTo && !on_edge;
  if (contact && ground) {
    if (share < 1.0 - 0.5 * plan.gait->pre_stance) note(LegEvent::kEarlyContact);
    return true;
  }
  if (wanted_m_.z() > ground_z_m_ - plan.law->step_down_m || share < 1.0) return false;
  note(LegEvent::kNoGround);
  return gave_up_ = true;
}

}  // namespace sprung
