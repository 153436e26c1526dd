#include "tools/lab/estimation/contact_scorer.h"

namespace sprung {

namespace {

double percent(std::size_t part, std::size_t whole) noexcept {
  return whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : kNaN;
}

double milliseconds(std::int64_t us) { return 1e-3 * static_cast<double>(us); }

}  // namespace

ApproachClass approach_class(double speed_m_s) noexcept {
  if (speed_m_s > 1.0) return ApproachClass::kFast;
  return speed_m_s > 0.3 ? ApproachClass::kMedium : ApproachClass::kSlow;
}

void ContactScorer::begin_step() {
  finish();
  phase_ = Phase::kBefore;
  step_ = {};
  free_since_us_.reset();
  lost_us_.reset();
}

const std::vector<ContactStep>& ContactScorer::finish() {
  if (phase_ == Phase::kSwing || phase_ == Phase::kLanded) steps_.push_back(step_);
  phase_ = Phase::kNone;
  return steps_;
}

void ContactScorer::add(const JointState& estimate, const SimTruth& truth) {
  const bool reported = estimate.legs[leg_].contact;
  const bool force = truth.legs[leg_].true_contact_force_N[2] > 0.0;
  const std::int64_t now_us = truth.stamp.utime_us;
  switch (phase_) {
    case Phase::kNone:
      break;
    case Phase::kBefore:
      follow_take_off(force, reported, now_us);
      break;
    case Phase::kSwing:
      follow_swing(force, reported, now_us);
      break;
    case Phase::kLanded:
      follow_landing(reported, now_us);
      break;
  }
  const double height_m = truth.legs[leg_].true_foot_in_world_m[2];
  if (last_us_ >= 0 && now_us > last_us_)
    speed_m_s_ = -(height_m - last_height_m_) / (1e-6 * static_cast<double>(now_us - last_us_));
  last_height_m_ = height_m;
  last_us_ = now_us;
  reported_ = reported;
}

void ContactScorer::follow_take_off(bool force, bool reported, std::int64_t now_us) {
  if (reported_ && !reported) lost_us_ = now_us;
  if (force) {
    free_since_us_.reset();
    step_.false_alarm = false;
    return;
  }
  if (!free_since_us_) free_since_us_ = now_us;
  if (reported && !reported_) step_.false_alarm = true;
  if (now_us - *free_since_us_ < kFree_us) return;
  phase_ = Phase::kSwing;
  if (lost_us_) step_.lift_off_delay_ms = milliseconds(*lost_us_ - *free_since_us_);
  if (reported) step_.false_alarm = true;
}

void ContactScorer::follow_swing(bool force, bool reported, std::int64_t now_us) {
  if (!force) {
    step_.false_alarm = step_.false_alarm || reported;
    return;
  }
  phase_ = Phase::kLanded;
  touchdown_us_ = now_us;
  step_.approach_speed_m_s = speed_m_s_;
  if (!reported_) follow_landing(reported, now_us);
}

void ContactScorer::follow_landing(bool reported, std::int64_t now_us) {
  if (step_.delay_ms || !reported || reported_ || now_us - touchdown_us_ > kLatest_us) return;
  step_.delay_ms = milliseconds(now_us - touchdown_us_);
}

ContactCounts::ContactCounts(const std::vector<ContactStep>& all) noexcept : steps(all.size()) {
  for (const ContactStep& step : all) {
    touchdowns += step.approach_speed_m_s ? 1 : 0;
    found += step.delay_ms ? 1 : 0;
    false_alarms += step.false_alarm ? 1 : 0;
  }
}

double ContactCounts::found_percent() const noexcept { return percent(found, touchdowns); }
double ContactCounts::false_alarms_percent() const noexcept { return percent(false_alarms, steps); }

}  // namespace sprung
