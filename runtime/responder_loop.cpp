#include "runtime/responder_loop.h"

#include <algorithm>

#include "runtime/log.h"
#include "runtime/stop_request.h"

namespace sprung {
namespace {

/// Status is looked at this often when nothing else wakes the loop.
constexpr std::int64_t kLongestWait_us = 100'000;

void step(Process& process, ResponderShell& shell, std::int64_t seq) {
  process.statistics().begin_cycle(process.node().utime_us());
  const std::optional<Stamp> used = shell.step(seq);
  const std::int64_t done_us = process.node().utime_us();
  process.statistics().end_cycle(done_us);
  if (!used) return;
  process.status().stamp.seq = seq;
  if (!process.lockstep()) process.status().input_age_us = static_cast<double>(done_us - used->utime_us);
  if (process.status().state == ProcessState::kReady) process.set_state(ProcessState::kRunning);
}

void act(Process& process, ResponderShell& shell, const ResponderDecision& decision) {
  switch (decision.action) {
    case ResponderAction::kWait:
      process.node().wait_for_input(
          std::min(decision.wait_until_us, process.node().utime_us() + kLongestWait_us));
      return;
    case ResponderAction::kStep:
      return step(process, shell, decision.seq);
    case ResponderAction::kResend:
      return shell.resend(decision.seq);
    case ResponderAction::kRestart:
      log_warn("cycles began anew: starting over");
      return shell.restart();
  }
}

}  // namespace

std::unique_ptr<Responder> make_responder(const Process& process, const ResponderRole& role) {
  if (process.lockstep()) {
    LockstepTiming timing;
    timing.has_partner = role.has_partner;
    timing.partner_lag = role.partner_lag;
    return std::make_unique<LockstepResponder>(timing);
  }
  return std::make_unique<RealTimeResponder>();
}

int run_responder(Process& process, Responder& responder, ResponderShell& shell) {
  const Receiving receiving(process.node());
  process.set_state(ProcessState::kReady);
  while (!stop_requested()) {
    shell.between_cycles();
    ResponderView view = shell.look();
    view.now_us = process.node().utime_us();
    act(process, shell, responder.decide(view));
    const ResponderCounters& counters = responder.counters();
    process.status().sequence_gaps = counters.skipped_inputs + counters.missed_partners;
    process.publish_status_if_due();
  }
  return kExitDone;
}

}  // namespace sprung
