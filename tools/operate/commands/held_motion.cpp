#include "tools/operate/commands/held_motion.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <thread>

#include "runtime/stop_request.h"
#include "tools/operate/commands/answers.h"

namespace sprung::commands {
namespace {

// [design choice] Four renewals may be lost, over a network with 100 ms of jitter three. Slowing down and
// setting the feet come on top.
constexpr double kHold_s = 0.5;
constexpr double kRenew_s = 0.1;
constexpr double kLetGo_s = 0.001;  // of a last renewal: the hold is over in the next cycle
constexpr double kLapse_s = 0.05;   // until the planner has seen it
constexpr double kLongest_s = 3600.0;

void refuse_time(const HeldCall& call) {
  if (std::isnan(call.for_s)) {
    if (call.no_wait) throw WrongUse("--no-wait needs --for: who does not stay says for how long");
    return;
  }
  if (!(call.for_s > 0.0 && call.for_s <= kLongest_s))
    throw WrongUse("--for is more than 0 s and at most 3600 s");
}

/// As where the operator is gone: a walk ends sooner than by a stop, for no foot is set that need not be.
int let_go(OperatorClient& client) {
  client.renew_no_more();
  clear_stop_request();  // who asked for it waits for the end; the next signal ends the command at once
  OperatorCommand last;
  last.kind = OperatorKind::kHold;
  last.hold_s = kLetGo_s;
  client.send(last, kSilence_s);
  std::this_thread::sleep_for(std::chrono::duration<double>(kLapse_s));
  OperatorCommand order;
  order.kind = OperatorKind::kStop;
  const int status = motion_exit("stop", client.send(order, kAnswer_s));
  if (status != kExitDone) return status;
  return motion_exit("stop", client.wait_done(order, kSilence_s));
}

void renew(OperatorKind kind, OperatorClient& client) {
  OperatorCommand renewal;
  renewal.kind = kind;
  renewal.hold_s = kHold_s;
  client.renew(renewal, kRenew_s);
}

/// What is renewed already. @return exit status, once nothing is held any more.
int hold(const char* what, OperatorClient& client) {
  std::printf("%s: goes on while this command runs; Ctrl-C stops it\n", what);
  std::fflush(stdout);
  const std::optional<OperatorAnswer> last = client.wait_refused(kSilence_s);
  if (!stop_requested() && !last) return motion_exit(what, last);
  if (!stop_requested()) {
    std::printf("%s: has ended\n", what);
    return kExitDone;
  }
  return let_go(client);
}

}  // namespace

std::optional<OperatorAnswer> keep_saying(OperatorKind kind, OperatorClient& client) {
  renew(kind, client);
  return client.wait_refused(kSilence_s);
}

void add_held_call(CommandLine& command, HeldCall& call) {
  command.option("--for", call.for_s,
                 "s, then it stops by itself, whoever is there; default: it goes on while this command runs");
  add_motion_call(command, call);
}

int run_held(const char* what, OperatorCommand command, const HeldCall& call) {
  refuse_time(call);
  const RunInfo info = require_running(call.instance, call.robot);
  const bool stays = std::isnan(call.for_s) && info.clock != "lockstep";
  command.hold_s = stays ? kHold_s : call.for_s;
  command.apply_at_seq = call.at_seq;
  OperatorClient client(info);
  const std::optional<OperatorAnswer> answer = client.send(command, kAnswer_s);
  const int status = motion_exit(what, answer);
  if (status != kExitDone) return status;
  // What waits for its cycle cannot be held yet; what has begun must not wait for a `done` that may be lost.
  const bool queued = answer->outcome == OperatorOutcome::kQueued;
  if (stays && !queued) renew(OperatorKind::kHold, client);
  if (answer->outcome != OperatorOutcome::kDone) {  // which follows in the same cycle
    const int done = motion_exit(what, client.wait_done(command, kSilence_s));
    if (done != kExitDone) return done;
  }
  if (stays && queued) renew(OperatorKind::kHold, client);
  return stays ? hold(what, client) : status;
}

}  // namespace sprung::commands
