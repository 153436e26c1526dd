#pragma once
/// When estimator, planner and leg controller answer a cycle, under either clock. Pure: what the slots hold
/// and a wall time in, a decision out. Wall time decides only when to give up on a partner that has gone
/// silent.
///
/// Lock-step. Cycles are answered strictly in order; a cycle is skipped only when it cannot come any more
/// (its sender is two cycles further, or silent about it for `timeout`). A
/// responder with a partner (the leg controller: LEG_COMMAND) answers k >= 1 only with the partner's k-1, or,
/// when its lag is 0 (the estimator of a robot with an IMU), k only with the partner's k. A repeated input
/// that was answered already asks for the stored answers again: the bridge repeats DRIVE_STATE(k) after 50
/// ms, and so every lost message of the ring is repaired without stepping anything twice. What stays missing
/// for `timeout` (its sender died) is counted and done without; from then on only for `short_timeout`,
/// until it is there in time again.
///
/// Real time. The newest input is answered at once with the partner's newest of seq <= k-1; gaps are counted.
/// When no input comes, nothing is answered: to a responder that is silent the bridge itself reacts
/// (command_hold, command_stop).
#include <cstdint>
#include <optional>

#include "runtime/slot.h"

namespace sprung {

/// What a responder sees before it decides.
struct ResponderView {
  HeldSeqs inputs;
  HeldSeqs partners;                     ///< unused without a partner
  std::optional<std::int64_t> repeated;  ///< seq of an input that came again since the last decision
  std::int64_t now_us = 0;               ///< wall time, monotonic
};

enum class ResponderAction {
  kWait,    ///< until something comes in or wait_until_us
  kStep,    ///< answer input `seq` with the partner's newest value of seq <= seq - lag
  kResend,  ///< send the stored answers of seq - 1 and seq again
  kRestart  ///< the bridge began anew: fresh core, forget stored answers; then decide again
};

struct ResponderDecision {
  ResponderAction action = ResponderAction::kWait;
  std::int64_t seq = -1;
  std::int64_t wait_until_us = 0;  ///< same clock as now_us
};

struct ResponderCounters {
  std::int64_t missed_partners = 0;  ///< lock-step: answered without the partner's value
  std::int64_t skipped_inputs = 0;   ///< cycles never answered: the status' sequence gaps
  std::int64_t restarts = 0;
};

/// Common interface, so that one loop (responder_loop.h) serves both clocks.
class Responder {
 public:
  virtual ~Responder() = default;
  virtual ResponderDecision decide(const ResponderView& view) noexcept = 0;
  const ResponderCounters& counters() const noexcept { return counters_; }

 protected:
  ResponderCounters counters_;
};

struct LockstepTiming {
  bool has_partner = false;
  std::int64_t partner_lag = 1;  ///< cycle k waits for the partner's k - lag
  std::int64_t timeout_us = 300'000;
  std::int64_t short_timeout_us = 2'000;
};

class LockstepResponder : public Responder {
 public:
  explicit LockstepResponder(const LockstepTiming& timing) noexcept : timing_(timing) {}
  ResponderDecision decide(const ResponderView& view) noexcept override;

 private:
  bool input_is_here(const ResponderView& view) noexcept;
  bool partner_is_here(const ResponderView& view) noexcept;
  bool waited(std::int64_t now_us, std::int64_t timeout_us) noexcept;
  ResponderDecision wait(std::int64_t now_us) const noexcept;
  ResponderDecision restart() noexcept;

  LockstepTiming timing_;
  std::int64_t expected_ = 0;  ///< next cycle to answer
  bool partner_lost_ = false;
  std::optional<std::int64_t> give_up_us_;  ///< when waiting for something in particular
};

class RealTimeResponder : public Responder {
 public:
  ResponderDecision decide(const ResponderView& view) noexcept override;

 private:
  std::optional<std::int64_t> answered_;
};

}  // namespace sprung
