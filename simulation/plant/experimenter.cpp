#include "simulation/plant/experimenter.h"

#include <cmath>

namespace sprung::sim {
namespace {

constexpr std::uint16_t kOverCurrent = 0x2310;

}  // namespace

bool Experimenter::add(const SimControl& control) noexcept {
  if (count_ + running_count_ >= kCapacity) return false;
  waiting_[count_++] = control;
  return true;
}

void Experimenter::start_cycle(std::int64_t cycle) noexcept {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count_; ++i) {
    if (waiting_[i].apply_at_seq <= cycle) {
      act(waiting_[i]);
    } else {
      waiting_[kept++] = waiting_[i];
    }
  }
  count_ = kept;
}

void Experimenter::act(const SimControl& control) noexcept {
  SimDrive* drive = train_.drive(control.actuator);
  switch (control.kind) {
    case SimControlKind::kWrench:
      return push(control);
    case SimControlKind::kReset:
      stop_pushing();
      imu_.forget_motion();
      return train_.reset_plant();
    case SimControlKind::kSuspend:
      return control.value == 0.0 ? train_.plant().release() : train_.plant().suspend(control.value);
    case SimControlKind::kDriveFault:
      if (drive != nullptr)
        drive->raise_fault(control.value > 0.0 ? static_cast<std::uint16_t>(control.value) : kOverCurrent);
      return;
    case SimControlKind::kDriveSilent:
      if (drive != nullptr) drive->outbox().set_cut(control.value != 0.0);
      return;
    case SimControlKind::kNodeFault:
      return begin_fault(control);
    case SimControlKind::kFloor:
      return train_.plant().set_floor_height(control.value, control.actuator);
    case SimControlKind::kImu:
      return imu_.set_fault(control.value);
  }
}

void Experimenter::push(const SimControl& control) noexcept {
  const bool goes_on = steps_left_ > 0 && pushed_leg_ == control.actuator;
  from_wrench_ = goes_on ? wrench_ : std::array<double, 6>{};
  stop_pushing();
  pushed_leg_ = control.actuator;
  to_wrench_ = control.wrench;
  rise_steps_ = steps(control.value);
  steps_done_ = 0;
  steps_left_ = steps(control.duration_s);
  if (steps_left_ > 0) apply_wrench(rise_steps_ > 0 ? from_wrench_ : to_wrench_);
}

void Experimenter::apply_wrench(const std::array<double, 6>& wrench) noexcept {
  wrench_ = wrench;
  if (pushed_leg_ < 0) {
    train_.plant().set_base_wrench(wrench);
  } else {
    train_.plant().set_foot_wrench(pushed_leg_, wrench);
  }
}

void Experimenter::keep_pushing() noexcept {
  if (--steps_left_ == 0) return stop_pushing();
  if (++steps_done_ > rise_steps_) return;
  const double share = static_cast<double>(steps_done_) / static_cast<double>(rise_steps_);
  std::array<double, 6> wrench = to_wrench_;
  for (std::size_t i = 0; i < wrench.size(); ++i)
    wrench[i] = from_wrench_[i] + share * (to_wrench_[i] - from_wrench_[i]);
  apply_wrench(wrench);
}

void Experimenter::stop_pushing() noexcept {
  steps_left_ = 0;
  wrench_ = {};
  train_.plant().set_base_wrench({});
  train_.plant().set_foot_wrench(pushed_leg_, {});
}

std::int64_t Experimenter::steps(double duration_s) const noexcept {
  return std::llround(duration_s / train_.plant().step_s());
}

/// A fault that is at work already begins anew.
void Experimenter::begin_fault(const SimControl& control) noexcept {
  mend(control);
  if (control.fault == FaultKind::kNone) return;
  switch_fault(control, true);
  const std::int64_t left = steps(control.duration_s);
  if (left <= 0 && control.fault == FaultKind::kPowerCycle) return switch_fault(control, false);
  running_[running_count_++] = {control, left > 0 ? left : -1};
}

void Experimenter::switch_fault(const SimControl& control, bool on) noexcept {
  if (control.actuator >= 0) return train_.set_fault(control.actuator, control.fault, control.value, on);
  train_.set_bus_fault(control.bus, control.fault, control.value, on);
  buses_.set(control.bus, control.fault, on);
}

/// Ends what is at work on the same target, of the same kind or, for kNone, of any.
void Experimenter::mend(const SimControl& control) noexcept {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < running_count_; ++i) {
    const SimControl& other = running_[i].control;
    const bool target = other.actuator == control.actuator &&
                        (control.actuator >= 0 || other.bus == control.bus);
    const bool kind = control.fault == FaultKind::kNone || control.fault == other.fault;
    if (target && kind) {
      switch_fault(other, false);
    } else {
      running_[kept++] = running_[i];
    }
  }
  running_count_ = kept;
}

void Experimenter::after_step() noexcept {
  if (steps_left_ > 0) keep_pushing();
  std::size_t kept = 0;
  for (std::size_t i = 0; i < running_count_; ++i) {
    Running& fault = running_[i];
    if (fault.steps_left > 0 && --fault.steps_left == 0) {
      switch_fault(fault.control, false);
    } else {
      running_[kept++] = fault;
    }
  }
  running_count_ = kept;
}

}  // namespace sprung::sim
