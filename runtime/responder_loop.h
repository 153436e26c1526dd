#pragma once
/// The loop of a process that answers cycles: look, decide, act, account. The shell supplies the verbs.
#include <memory>

#include "runtime/process.h"
#include "runtime/responder.h"

namespace sprung {

/// The verbs of one process; called from run_responder() only, in the node's thread.
class ResponderShell {
 public:
  virtual ~ResponderShell() = default;
  virtual ResponderView look() = 0;  ///< what the slots hold; now_us is filled by the loop
  virtual bool step(
      std::int64_t seq) = 0;  ///< take input seq, run the core, keep and publish the answer; false: gone
  virtual void resend(
      std::int64_t seq) = 0;        ///< publish stored answers of seq - 1 and seq, as far as they are stored
  virtual void restart() = 0;       ///< fresh core, no stored answers
  virtual void inputs_stopped() {}  ///< only where RealTimeTiming::answers_stop
  virtual void between_cycles() {}  ///< operator commands and the like; called once a turn
};

enum class StopAnswer { kNone, kDamping };
/// Lock-step or real-time responder, as the process' options say.
std::unique_ptr<Responder> make_responder(const Process& process, bool has_partner, StopAnswer stop_answer);

/// Publishes kReady, kRunning from the first answer on, and status; returns 0 on a stop request.
int run_responder(Process& process, Responder& responder, ResponderShell& shell);

}  // namespace sprung
