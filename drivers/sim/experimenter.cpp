#include "drivers/sim/experimenter.h"

#include <cmath>

namespace sprung::sim {
namespace {

constexpr std::uint16_t kOverCurrent = 0x2310;

}  // namespace

bool Experimenter::add(const SimControl& control) noexcept {
  if (count_ == kCapacity) return false;
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
      if (drive != nullptr) drive->set_fault(control.fault, control.value, true);
      return;
  }
}

void Experimenter::push(const SimControl& control) noexcept {
  stop_pushing();
  pushed_leg_ = control.actuator;
  steps_left_ = std::llround(control.duration_s / train_.plant().step_s());
  if (steps_left_ <= 0) return;
  if (pushed_leg_ < 0) {
    train_.plant().set_base_wrench(control.wrench_on_base);
  } else {
    train_.plant().set_foot_wrench(pushed_leg_, control.wrench_on_base);
  }
}

void Experimenter::stop_pushing() noexcept {
  steps_left_ = 0;
  train_.plant().set_base_wrench({});
  train_.plant().set_foot_wrench(pushed_leg_, {});
}

void Experimenter::after_step() noexcept {
  if (steps_left_ > 0 && --steps_left_ == 0) stop_pushing();
}

}  // namespace sprung::sim
