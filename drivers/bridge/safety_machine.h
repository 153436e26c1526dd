#pragma once
/// What the robot may do, and why (design section 8): the bridge's part of the table. Pure; stepped by time.
///
///   cause                                    level                                       latched
///   starting, no arming command yet          disabled                                    no
///   command stale > command_hold, or expired damping                                     no
///   command stale > command_stop             quick stop                                  yes
///   LEG_COMMAND older than command_stop      lowering by the leg controller, 1.5 s   yes
///                                            at most; then as the next
///   drive or card: fault, silence,           damping until slow for 0.3 s, or 5 s,       yes
///   implausible value, two on one node id,   then quick stop
///   another master
///   bus lost, another master that insists    quick stop                                  yes
///   overruns in a row                        damping, until a cycle is in time again     no
///   a drive differs from robot.yaml          disabled                                    yes
///   emergency stop, by operator or input     disabled                                    yes
///   shutdown                                 damping until slow for 0.3 s, or 1 s,       yes
///                                            then disabled
///
/// Lowering needs DRIVE_COMMANDs: a stale one makes it damping. A latched state only gets worse, until
/// clear(). The cause stays the first one, unless a worse level brings its own. A damping that was not
/// latched and is over stays in the detail until it is forgotten: by then the motion has ended, and nobody
/// would know why.
#include <cstdint>

#include "drivers/bridge/detail_text.h"
#include "robots/robot_config.h"
#include "signals/safety_state.h"

namespace sprung {

/// One reason to stop, with the sentence for people.
struct Fault {
  SafetyCause cause = SafetyCause::kNone;
  int actuator = -1;
  DetailText detail{};
  /// The status word says fault; the emergency message with its code is on its way.
  bool unexplained = false;
};

struct SafetyInputs {
  std::int64_t time_us = 0;
  std::int64_t cycle = -1;
  bool armed = false;            ///< a good command with every mode disabled came since start, clear or latch
  double command_age_s = 0.0;    ///< of the last good command, 0 = of this cycle
  bool command_expired = false;  ///< it may not be emitted any more, however young it is
  bool command_refused = false;  ///< commands do come, but are refused
  const DetailText* refusal = nullptr;
  const Fault* drive = nullptr;    ///< fault, silence, implausible value; nullptr = none
  const Fault* planner = nullptr;  ///< no LEG_COMMAND for long; nullptr = none
  const Fault* bus = nullptr;      ///< no damping over it: bus lost, another master insists; nullptr = none
  int overruns_in_row = 0;
  bool slow = false;  ///< all actuators nearly at rest; for a while ends a latched damping
};

class SafetyMachine {
 public:
  /// @param lowering_s in which the leg controller lets the robot down.
  explicit SafetyMachine(const WatchdogConfig& watchdogs, double lowering_s = RobotConfig().lowering_s);

  void update(const SafetyInputs& inputs) noexcept;
  /// At once; also before cyclic operation. A drive refused while something else is latched only explains
  /// itself in the detail.
  /// @param fault nullptr: it is the operator's.
  void emergency_stop(std::int64_t time_us, std::int64_t cycle, const Fault* fault = nullptr) noexcept;
  void refuse_drive(const Fault& fault, std::int64_t time_us, std::int64_t cycle) noexcept;
  void begin_shutdown(std::int64_t time_us, std::int64_t cycle) noexcept;
  /// Forgets a latched cause; the caller has made sure that it is gone.
  void clear(std::int64_t time_us, std::int64_t cycle) noexcept;
  /// What was not latched and is over.
  void forget_past() noexcept {
    past_ = {};
    past_is_told_ = false;
  }

  SafetyLevel level() const noexcept { return state_.level; }
  SafetyCause cause() const noexcept { return state_.cause; }
  bool latched() const noexcept { return state_.latched; }
  /// A drive that says fault has not said yet which: its message is still of use.
  bool unexplained() const noexcept { return unexplained_; }
  /// Level, cause, latched, actuator, since_seq and detail; the bridge fills the counters.
  const SafetyState& state() const noexcept { return state_; }

 private:
  void enter(SafetyLevel level, bool latched, const Fault& fault, std::int64_t time_us,
             std::int64_t cycle) noexcept;
  void keep_past() noexcept;
  void latch(SafetyLevel level, const Fault& fault, const SafetyInputs& inputs) noexcept;
  void worsen(const SafetyInputs& inputs) noexcept;
  void explain(const SafetyInputs& inputs) noexcept;
  void lower(const SafetyInputs& inputs) noexcept;
  void follow_commands(const SafetyInputs& inputs) noexcept;
  bool lasted(double duration_s, std::int64_t time_us) const noexcept;  ///< the level in force

  WatchdogConfig watchdogs_;
  double lowering_s_;
  SafetyState state_;
  bool unexplained_ = false;
  DetailText past_{};
  bool past_is_told_ = false;  ///< in the detail, while operational
  std::int64_t since_us_ = 0;
  std::int64_t slow_since_us_ = 0;  ///< while damping for good
};

}  // namespace sprung
