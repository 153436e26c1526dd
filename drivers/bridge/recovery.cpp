#include "drivers/bridge/recovery.h"

#include <algorithm>
#include <cstdio>

namespace sprung {
namespace {

/// [design choice] ten resets of a node that does not answer.
constexpr std::int64_t kRecoveryTimeout_us = 5'000'000;
constexpr std::int64_t kReset_us = 300'000;  // [design choice] several edges of the fault-reset bit
constexpr std::int64_t kWatch_us = 500'000;  // [design choice] for the first heartbeats and answers

const char* fault_of(const NodeLink& link, std::int64_t time_us) noexcept {
  if (link.duplicate()) return "two devices with this id";
  if (link.boot().refused()) return "was refused";
  if (link.heartbeats().rebooted()) return "restarted";
  if (link.silent()) return "silent";
  return link.lost(time_us) ? "not operational or no heartbeat" : "";
}

}  // namespace

Recovery::Recovery(std::vector<BusNode*> nodes) : nodes_(std::move(nodes)), plans_(nodes_.size()) {}

void Recovery::begin(Kind kind, std::int64_t time_us) noexcept {
  kind_ = kind;
  begun_us_ = time_us;
  failed_ = false;
  reason_ = "";
  std::fill(plans_.begin(), plans_.end(), Plan{});
  if (kind == Kind::kFirstCycle) {
    begin_reset();
    enter(Phase::kResetting, time_us);
    return;
  }
  enter(Phase::kStopping, time_us);
}

void Recovery::enter(Phase phase, std::int64_t time_us) noexcept {
  phase_ = phase;
  phase_us_ = time_us;
}

void Recovery::fail(const char* reason) noexcept {
  if (failed_) return;
  failed_ = true;
  reason_ = reason;
}

void Recovery::abort(const char* reason) noexcept {
  if (running()) fail(reason);
}

Recovery::Result Recovery::step(std::int64_t time_us) noexcept {
  if (!running()) return Result::kNothing;
  const bool over = !failed_ && step_phase(time_us);
  if (!over && !failed_ && time_us - begun_us_ > kRecoveryTimeout_us) {
    fail(phase_ == Phase::kStopping  ? "a drive does not stop"
         : phase_ == Phase::kBooting ? "a node does not answer or cannot be configured; see BUS_STATE"
                                     : "a drive is still in fault; see BUS_STATE");
  }
  if (failed_) return finish(false);
  return over ? finish(true) : Result::kNothing;
}

/// One phase's work. @return true when the last one is over.
bool Recovery::step_phase(std::int64_t time_us) noexcept {
  switch (phase_) {
    case Phase::kStopping:
      if (kind_ == Kind::kClear && !stop_over()) return false;
      plan_restarts(time_us);
      enter(Phase::kBooting, time_us);
      return false;
    case Phase::kBooting:
      if (!boots_over()) return false;
      if (kind_ == Kind::kBoot) return true;
      begin_reset();
      enter(Phase::kResetting, time_us);
      return false;
    case Phase::kResetting:
      if (!resets_over(time_us)) return false;
      if (kind_ == Kind::kClear && escalate()) {
        enter(Phase::kBooting, time_us);
        return false;
      }
      if (kind_ == Kind::kFirstCycle) return true;
      enter(Phase::kWatching, time_us);
      return false;
    case Phase::kWatching:
      break;
  }
  if (all_well(time_us)) return true;
  if (time_us - phase_us_ > kWatch_us) fail("a drive is in fault again; see BUS_STATE");
  return false;
}

/// Of a node that does not answer nothing is known but its last word.
bool Recovery::stop_over() const noexcept {
  return std::none_of(nodes_.begin(), nodes_.end(), [](const BusNode* node) {
    return node->condition().powered && !node->link().silent();
  });
}

void Recovery::plan_restarts(std::int64_t time_us) noexcept {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    const NodeLink& link = nodes_[i]->link();
    Plan& plan = plans_[i];
    plan.restart = kind_ == Kind::kBoot ? link.boot().refused() : link.needs_restart(time_us);
    plan.reset = nodes_[i]->condition().faulted;
    plan.emergency_code = link.emergencies().emergency().code;
    plan.bus_loss = link.bus_loss();
    plan.fault = fault_of(link, time_us);
    if (plan.restart) nodes_[i]->restart();
  }
}

bool Recovery::waits_for(std::size_t i) const noexcept {
  const NodeBoot& boot = nodes_[i]->link().boot();
  const bool booted = kind_ == Kind::kBoot ? boot.configured() || boot.started() : boot.operational();
  return plans_[i].restart && !booted;
}

bool Recovery::boots_over() noexcept {
  bool over = true;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i]->link().boot().refused()) fail("a node differs from robot.yaml; see SAFETY_STATE");
    over = over && !waits_for(i);
  }
  return over;
}

void Recovery::begin_reset() noexcept {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    plans_[i].reset = plans_[i].reset || nodes_[i]->condition().faulted;
    nodes_[i]->reset_faults(true);
  }
}

/// Also when time ran out: what is still in fault counts as a fault again.
bool Recovery::resets_over(std::int64_t time_us) noexcept {
  const bool good = std::none_of(nodes_.begin(), nodes_.end(),
                                 [](const BusNode* n) { return n->condition().faulted; });
  for (BusNode* node : nodes_) node->reset_faults(true);
  if (!good && time_us - phase_us_ < kReset_us) return false;
  for (BusNode* node : nodes_) node->reset_faults(false);
  return true;
}

/// A fault that stays although it was reset may have a lost link behind it, which only a reset of the
/// communication heals (facts canopen 2.5): the emergency that said so may not have been heard. Once for each
/// node; then it fails.
/// @return true when nodes are booting again.
bool Recovery::escalate() noexcept {
  bool restarted = false;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (!nodes_[i]->condition().faulted) continue;
    if (plans_[i].restart) fail("a drive's fault cannot be reset; see BUS_STATE");
  }
  if (failed_) return false;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (!nodes_[i]->condition().faulted) continue;
    plans_[i].restart = restarted = true;
    nodes_[i]->restart();
  }
  return restarted;
}

bool Recovery::all_well(std::int64_t time_us) const noexcept {
  Fault fault;
  return std::none_of(nodes_.begin(), nodes_.end(), [&](const BusNode* node) {
    return !node->link().samples().answered() || node->fault(time_us, false, fault);
  });
}

Recovery::Result Recovery::finish(bool good) noexcept {
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    if (!good) nodes_[i]->reset_faults(false);
    if (kind_ != Kind::kFirstCycle) write_text(i);
  }
  kind_ = Kind::kNone;
  return good ? Result::kDone : Result::kFailed;
}

/// "bus was off, fault 0x8130 life guard or heartbeat lost"
void Recovery::write_before(const Plan& plan, std::array<char, 64>& out) noexcept {
  const bool of_bus = *plan.bus_loss != 0;
  std::array<char, 48> own{};
  if (plan.emergency_code != 0) {
    std::snprintf(own.data(), own.size(), "fault 0x%04X %.32s", plan.emergency_code,
                  canopen::emergency_text(static_cast<std::uint16_t>(plan.emergency_code)));
  } else {
    const char* unnamed = of_bus ? "" : "fault";
    std::snprintf(own.data(), own.size(), "%s", *plan.fault != 0 ? plan.fault : unnamed);
  }
  std::snprintf(out.data(), out.size(), "%s%s%s", plan.bus_loss, of_bus && own[0] != 0 ? ", " : "",
                own.data());
}

void Recovery::write_text(std::size_t i) noexcept {
  const Plan& plan = plans_[i];
  NodeLink& link = nodes_[i]->link();
  const NodeCondition condition = nodes_[i]->condition();
  std::array<char, 64> before{};
  write_before(plan, before);
  if (!plan.restart && !plan.reset) {
    link.set_recovery_text(condition.note, "nothing to do");
  } else if (plan.restart && link.boot().refused()) {
    link.set_recovery_text(condition.note, "%.127s", link.boot().detail().data());
  } else if (waits_for(i)) {
    link.set_recovery_text(condition.note, "no answer on node %d: power, cable?", link.setup().node);
  } else if (condition.faulted) {
    link.set_recovery_text(condition.note, "%s: cannot be reset", before.data());
  } else if (plan.restart) {
    link.set_recovery_text(condition.note, "%s: reset communication, configured again (%d objects)%s",
                           before.data(), link.boot().settings(), plan.reset ? ", fault reset" : "");
  } else {
    link.set_recovery_text(condition.note, "%s: fault reset", before.data());
  }
}

}  // namespace sprung
