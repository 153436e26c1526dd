#pragma once
/// The loop of a process that answers cycles: look, decide, act, account. The shell supplies the verbs.
#include <memory>
#include <optional>

#include "runtime/process.h"
#include "runtime/responder.h"
#include "signals/stamp.h"

namespace sprung {

/// The verbs of one process; called from run_responder() only, in the node's thread.
class ResponderShell {
 public:
  virtual ~ResponderShell() = default;
  virtual ResponderView look() = 0;  ///< what the slots hold; now_us is filled in by the loop
  /// Take input seq, run the core, keep and publish the answer. @return the input's stamp; nothing when it is
  /// gone.
  virtual std::optional<Stamp> step(std::int64_t seq) = 0;
  virtual void resend(
      std::int64_t seq) = 0;   ///< publish the stored answers of seq - 1 and seq, as far as they are stored
  virtual void restart() = 0;  ///< fresh core, no stored answers
  virtual void between_cycles() {}  ///< operator commands and the like; called once a turn, before look()
};

struct ResponderRole {
  bool has_partner = false;  ///< lock-step waits for the partner's seq - lag
  std::int64_t partner_lag = 1;
};

/// Lock-step or real-time responder, as the process' clock asks.
std::unique_ptr<Responder> make_responder(const Process& process, const ResponderRole& role);

/// Starts the node; publishes kReady, kRunning from the first answer on, and status. @return 0 after a stop
/// request.
int run_responder(Process& process, Responder& responder, ResponderShell& shell);

}  // namespace sprung
