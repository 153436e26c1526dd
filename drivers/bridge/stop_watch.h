#pragma once
/// Sees that a stop of one drive works, and goes on by other ways where it does not: as SS1 of IEC 61800-5-2
/// supervises a stop and then takes the torque off, without its claims (docs/safety.md). Pure; stepped by
/// time.
///
///   step         what goes to the drive                          begins
///   kNone        nothing is wanted, or the power was seen off
///   kPdo         control words by RPDO, as ever                  when a stop is wanted
///   kSdo         0x6040 = 0 by SDO, and 0x6041 read              when kPdo has had its time, or at once (1)
///   kReset       NMT reset node as well                          100 ms later
///   kWithhold    and no heartbeat on its bus: its own            100 ms later, where it is alive (2)
///                watchdog acts
///   kGivenUp     control words by RPDO; cut its supply           500 ms later, or instead of kWithhold
///
/// (1) Where it has left operational, and so takes no RPDOs. (2) One that is not heard may hear, and then
/// obeys a reset.
#include <cstdint>

namespace sprung {

enum class StopStep : std::int8_t { kNone, kPdo, kSdo, kReset, kWithhold, kGivenUp };
const char* text(StopStep step) noexcept;  ///< for people; "" for kNone

struct StopInputs {
  std::int64_t time_us = 0;
  bool wanted = false;     ///< no power is wanted in this drive, whatever it does
  bool brakes = false;     ///< it may brake first: its own quick stop
  bool seen_off = false;   ///< by an answer of now
  bool takes_pdos = true;  ///< false: it has left operational
  bool alive = true;       ///< it was heard lately
};

class StopWatch {
 public:
  /// @return the step in force from now on.
  StopStep update(const StopInputs& inputs) noexcept;
  StopStep step() const noexcept { return step_; }
  /// The worst step of the last stop: one that was not obeyed at once is news after it has worked, too.
  StopStep worst() const noexcept { return worst_; }
  /// By SDO: what an RPDO says is not enough, or not heard.
  bool by_sdo() const noexcept { return step_ >= StopStep::kSdo && step_ != StopStep::kGivenUp; }
  /// A reset is due now; every 100 ms.
  bool take_reset(std::int64_t time_us) noexcept;
  void forget() noexcept { *this = StopWatch(); }

 private:
  void enter(StopStep step, std::int64_t time_us) noexcept;

  StopStep step_ = StopStep::kNone;
  StopStep worst_ = StopStep::kNone;
  std::int64_t since_us_ = 0;
  std::int64_t next_reset_us_ = 0;
};

}  // namespace sprung
