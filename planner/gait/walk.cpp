#include "planner/gait/walk.h"

#include <algorithm>
#include <cmath>

#include "model/leg_kinematics.h"
#include "robots/gait_speed.h"

namespace sprung {
namespace {

constexpr double kHeadingGain_1_s = 1.0;
constexpr double kMostHeadingCorrection_rad_s = 0.2;
constexpr double kHeightRate_m_s = 0.05;  // of a wanted height or width
constexpr double kSlip_m = 0.03;          // more than feet that hold move against each other
constexpr double kMostStretch_m = 0.04;  // of a standing foot's spring along the ground, in a gait that steps
constexpr double kFootholdRate_m_s = 0.2;  // [design choice] on top of what a swinging foot does
constexpr double kFarFoot_m = 0.4;         // of the trunk's middle

double toward(double from, double to, double most) noexcept {
  return from + std::clamp(to - from, -most, most);
}

}  // namespace

Walk::Walk(const RobotConfig& robot, const PresetConfig& preset)
    : law_(preset.walk),
      gaits_(robot.gaits),
      cycle_s_(robot.cycle_s),
      stand_height_m_(preset.stand_length_m),
      shape_(robot),
      weight_(shape_.legs),
      distribution_(preset.walk.floor_friction),
      feet_(robot.legs.size()) {
  width_m_ = law_.stance_width_m;
  for (const GaitConfig& gait : gaits_) backward_gaits_.push_back(backward_order(gait, shape_));
  adjust(adjustable_of(robot, preset));
}

Vec3 Walk::stance_foot_in_hip_m(std::size_t leg, double height_m) const noexcept {
  Eigen::Vector3d foot = shape_.foot_beside_hip_m[leg];
  if (!gaits_.empty()) foot.y() += shape_.side[leg] * width_m_;
  foot.z() = -height_m;
  return to_vec3(foot);
}

void Walk::begin(const JointState& in, const WalkRequest& request) noexcept {
  view_ = BodyView::of(in, shape_);
  request_ = request;
  wanted_ = {};  // not the order of a walk before this one
  wanted_ = now_ = order_of(request);
  start_clock();
  ramp_.reset();
  ramp_.want(request.speed);
  heat_.begin(in);
  heat_lean_.reset();
  waits_ = false;
  careful_s_ = 0.0;
  pace_.reset();
  for (std::size_t i = 0; i < shape_.legs; ++i) {
    steps_[i].stand(view_.foot_m[i], law_.force_rise_s);  // it carries its share already
    steps_[i].forget_event();
  }
  ground_.begin(ground_feet(), view_.attitude.yaw_rad);
  lie_along_ground();
  weight_.begin(leaning_m());
  height_m_ = -ground_.z_m();
  heading_rad_ = view_.attitude.yaw_rad;
  body_m_s_.setZero();
  period_begins_ = whole_period_ended_ = false;
  last_us_ = in.stamp.utime_us;
  stopping_ = halting_ = ended_ = false;
  placing_ = false;
  failure_ = nullptr;
  share_weight();
}

void Walk::start_clock() noexcept {
  const auto place = static_cast<std::size_t>(now_.gait);
  clock_.begin(now_.backward ? backward_gaits_[place] : gaits_[place], shape_.legs);
  lead_s_ = 0.5 * clock_.stance_s();
  whole_period_ = false;
}

void Walk::advance_clock(double dt_s) noexcept {
  const double phase = clock_.phase();
  clock_.advance(waits_ ? 0.0 : dt_s);
  period_begins_ = gait().duty < 1.0 && clock_.phase() < phase;
  whole_period_ = whole_period_ && !clock_.holds();
  whole_period_ended_ = period_begins_ && whole_period_;
  if (period_begins_) whole_period_ = !clock_.holds();
}

void Walk::fail(const char* why) noexcept {
  if (failure_ == nullptr) failure_ = why;
  clock_.hold();
  stop();
}

void Walk::step(const JointState& in) noexcept {
  const double dt_s = 1e-6 * static_cast<double>(in.stamp.utime_us - last_us_);
  last_us_ = in.stamp.utime_us;
  if (ended_ || dt_s <= 0.0) return;
  view_ = BodyView::of(in, shape_);
  heat_.step(in);
  if (heat_.too_warm() && gait().duty < 1.0 && failure_ == nullptr)
    fail("a motor is too warm to walk on: let it cool");
  heat_lean_.step(in, shape_, gait().sway_m <= 0.0 && !placing_, dt_s);
  steer(dt_s);
  lean(dt_s);
  step_legs(in, dt_s);
  follow_ground(dt_s);
  hold_height(dt_s);
  share_weight();
  next_gait();
}

/// As ramped, and slower with warm motors.
Pace::Speed Walk::desired_speed() const noexcept {
  Pace::Speed out = ramp_.now();
  for (double& part : out) part *= heat_.speed_share();
  return out;
}

void Walk::steer(double dt_s) noexcept {
  ramp_.advance(dt_s, starting_acceleration(gait()));
  height_m_ = toward(height_m_, request_.height_m, kHeightRate_m_s * dt_s);
  width_m_ = toward(width_m_, request_.stance_width_m, kHeightRate_m_s * dt_s);
  pace_.advance(waits_, desired_speed(), gait(), dt_s);
  follow_lead(dt_s);
  const double wanted_rad_s = pace_.now() * pace_.speed()[2];
  heading_rad_ += wanted_rad_s * dt_s;
  const double error_rad = view_.uses_imu ? wrapped_rad(heading_rad_ - view_.attitude.yaw_rad) : 0.0;
  turning_rad_s_ = wanted_rad_s + std::clamp(kHeadingGain_1_s * error_rad, -kMostHeadingCorrection_rad_s,
                                             kMostHeadingCorrection_rad_s);
}

/// Half a stance; of a body that comes to rest, at even deceleration, half of what is left. A change moves
/// the footholds, which swinging feet follow.
void Walk::follow_lead(double dt_s) noexcept {
  const double middle_s = 0.5 * clock_.stance_s();
  const double wanted_s = placing_ ? std::min(middle_s, 0.5 * ramp_.left_s()) : middle_s;
  const double speed_m_s = std::hypot(pace_.speed()[0], pace_.speed()[1]) +
                           kFarFoot_m * std::abs(pace_.speed()[2]);
  const double most_1 = kFootholdRate_m_s / std::max(speed_m_s, kFootholdRate_m_s / 10.0);
  lead_s_ = toward(lead_s_, wanted_s, most_1 * dt_s);
}

/// So much, on its way down, that it can only stand, whatever the estimator says of contact: a slow touchdown
/// is within what friction hides, and a foot that nobody believes to stand would push the robot over. Not
/// before: the quick part of a swing feigns as much.
bool Walk::bears(std::size_t i, const EstimatedLeg& leg) const noexcept {
  /// Of the weight: more than slow swings were seen to feign (90 N of 294 N)
  constexpr double kCertain = 0.35;
  if (steps_[i].phase() != LegPhase::kPreStance) return false;
  const Eigen::Vector3d force_N = view_.level_from_trunk * to_eigen(leg.foot_force_N);
  return force_N.z() > kCertain * shape_.mass_kg * kGravity_m_s2;
}

/// The leg whose step would end too late stays where it is, and so do all that would follow it.
void Walk::run_out(double dt_s) noexcept {
  halt_left_s_ -= dt_s;
  if (halt_left_s_ < clock_.swing_s()) clock_.hold();
}

/// Its swing goes on for longer than the clock's.
bool Walk::looks_on(std::size_t leg) const noexcept {
  const double share = clock_.swing_share(leg);
  return !steps_[leg].stands() && (share >= 1.0 || steps_[leg].behind(share * clock_.swing_s()));
}

void Walk::step_legs(const JointState& in, double dt_s) noexcept {
  if (halting_) run_out(dt_s);
  waits_ = weight_.holds();
  for (std::size_t i = 0; i < shape_.legs; ++i) waits_ = waits_ || (clock_.swings(i) && looks_on(i));
  advance_clock(dt_s);
  StepPlan plan{&gait(),          &law_,     request_.control, dt_s,
                clock_.swing_s(), body_m_s_, turning_rad_s_,   ground_.sunk_m()};
  plan.may_wait = gait().sway_m > 0.0 && !halting_ && failure_ == nullptr;
  for (std::size_t i = 0; i < shape_.legs; ++i) {
    plan.foot_radius_m = shape_.foot_radius_m[i];
    plan.bears = bears(i, in.legs[i]);
    if (clock_.swings(i) && steps_[i].stands()) steps_[i].lift(view_.foot_m[i]);
    const Eigen::Vector3d foothold = foothold_m(i);
    plan.ahead_m = (foothold - under_hip_m(i)).head<2>();
    if (!steps_[i].step(plan, view_.foot_m[i], foothold, in.legs[i].contact || plan.bears)) continue;
    clock_.land(i);
    if (halting_) weight_.stay();  // it came over three feet, and stands on four as well
    join(i);
    if (steps_[i].gave_up()) fail("a foot found no ground");
  }
  for (std::size_t i = 0; i < shape_.legs; ++i) look_for_slip(i);
  for (std::size_t i = 0; i < shape_.legs; ++i) yield(i);
}

/// A foot that landed takes over the others' pull; what its own spring had lagged by when it left is not
/// forgotten, but way to catch up with.
void Walk::join(std::size_t leg) noexcept {
  const Eigen::Vector3d pull = pull_m(leg);
  const Eigen::Vector3d behind_m = (pull - steps_[leg].stretch_at_lift_m()) /
                                   static_cast<double>(shape_.legs);
  pace_.lose(behind_m.x(), behind_m.y());
  steps_[leg].shift(pull);
}

/// How far the feet that stand are from where they are wanted, on average: what a foot that joins them takes
/// over, so that the springs' pull on the body does not begin anew with every step.
Eigen::Vector3d Walk::pull_m(std::size_t joining) const noexcept {
  Eigen::Vector3d sum_m = Eigen::Vector3d::Zero();
  int feet = 0;
  for (std::size_t i = 0; i < shape_.legs; ++i) {
    if (i == joining || !steps_[i].stands()) continue;
    sum_m += steps_[i].wanted_m() - view_.foot_m[i];
    ++feet;
  }
  return feet == 0 ? sum_m : Eigen::Vector3d(sum_m / feet);
}

/// Off an edge, in a gait that stands on three: no further than feet look for the ground.
bool Walk::fell(std::size_t leg, double by_m) const noexcept {
  const double lowest_m = ground_.z_m(view_.foot_m[leg]) - law_.step_down_m;
  return gait().sway_m > 0.0 && law_.distribute_force && !view_.carries[leg] && by_m < -kSlip_m &&
         steps_[leg].wanted_m().z() + by_m > lowest_m;
}

/// A standing foot that moved against the others slips: it is wanted where it is now, so that its spring does
/// not drag it further.
void Walk::look_for_slip(std::size_t leg) noexcept {
  LegStep& step = steps_[leg];
  if (!step.stands()) return;
  Eigen::Vector3d by_m = view_.foot_m[leg] + pull_m(leg) - step.wanted_m();
  if (!fell(leg, by_m.z())) by_m.z() = 0.0;
  if (!(by_m.norm() > kSlip_m)) return;
  step.note(LegEvent::kSlip);
  step.shift(by_m);
}

/// A robot that was pushed goes on from where it is: springs that would pull it all the way back throw it
/// over to the other side.
void Walk::yield(std::size_t leg) noexcept {
  LegStep& step = steps_[leg];
  if (!step.stands() || gait().duty >= 1.0) return;
  Eigen::Vector3d stretch_m = step.wanted_m() - view_.foot_m[leg];
  stretch_m.z() = 0.0;
  const double length_m = stretch_m.norm();
  if (length_m > kMostStretch_m) step.shift((kMostStretch_m / length_m - 1.0) * stretch_m);
}

}  // namespace sprung
