#pragma once
/// Brings a robot back after trouble, without a new process, in the order of facts canopen 2.5: wait until
/// the drives have stopped; reset the communication of every node that needs it and configure it again; start
/// it; reset faults; see that all is well. Nodes without trouble are left alone and keep their SYNC. Goes
/// through it over cycles. Pure.
#include <array>
#include <cstdint>
#include <vector>

#include "drivers/bridge/bus_node.h"

namespace sprung {

class Recovery {
 public:
  enum class Kind : std::int8_t {
    kNone,
    kFirstCycle,  ///< drives often come up with a fault: reset it, and judge afterwards
    kBoot,        ///< clear before the first cycle: nodes that were refused are tried again
    kClear,
  };
  enum class Result : std::int8_t { kNothing, kDone, kFailed };

  explicit Recovery(std::vector<BusNode*> nodes);

  void begin(Kind kind, std::int64_t time_us) noexcept;
  /// Once a cycle, when the nodes' answers have been judged. kDone and kFailed are told once.
  Result step(std::int64_t time_us) noexcept;
  /// Something worse came: ends with kFailed at the next step.
  void abort(const char* reason) noexcept;

  Kind kind() const noexcept { return kind_; }  ///< of what is under way
  bool running() const noexcept { return kind_ != Kind::kNone; }
  /// Why it failed, for people. Static text.
  const char* reason() const noexcept { return reason_; }

 private:
  enum class Phase : std::int8_t { kStopping, kBooting, kResetting, kWatching };
  /// What one node needs.
  struct Plan {
    bool restart = false;
    bool reset = false;  ///< it had a fault to reset
    int emergency_code = 0;
    const char* bus_loss = "";  ///< static text
    const char* fault = "";     ///< static text
  };

  void enter(Phase phase, std::int64_t time_us) noexcept;
  bool step_phase(std::int64_t time_us) noexcept;
  bool stop_over() const noexcept;
  void plan_restarts(std::int64_t time_us) noexcept;
  bool boots_over() noexcept;
  void begin_reset() noexcept;
  bool resets_over(std::int64_t time_us) noexcept;
  bool escalate() noexcept;
  bool all_well(std::int64_t time_us) const noexcept;
  Result finish(bool good) noexcept;
  void write_text(std::size_t i) noexcept;
  static void write_before(const Plan& plan, std::array<char, 64>& out) noexcept;
  void fail(const char* reason) noexcept;
  bool waits_for(std::size_t i) const noexcept;

  std::vector<BusNode*> nodes_;
  std::vector<Plan> plans_;
  Kind kind_ = Kind::kNone;
  Phase phase_ = Phase::kStopping;
  std::int64_t begun_us_ = 0;
  std::int64_t phase_us_ = 0;
  const char* reason_ = "";
  bool failed_ = false;
};

}  // namespace sprung
