#pragma once
/// A drive's own side of CiA 402: power states, option codes, and what the drive does by itself. Pure,
/// stepped once a tick.
///
/// The option codes say whether the drive brakes first (not 0) or lets the motor coast (0): 0x605A quick
/// stop, 0x605B shutdown, 0x605C disable operation, 0x605E fault reaction. Braking ends without power, when
/// slow or after kBrakeTime_s; but 0x605A = 5 to 8 stays in quick stop with power until the master says
/// otherwise, also to go on (CiA 402's transition 16). Halt (control bit 8) brakes with power for as long as
/// it is asked, whichever of 0x605D's ways is chosen. How a real drive brakes in a current mode is
/// [unverified].
#include <cstdint>

#include "signals/modes.h"

namespace sprung::sim {

struct PowerOptions {
  int quick_stop = 0;
  int shutdown = 0;
  int disable = 0;
  int fault_reaction = 0;
};

/// Stages of an EPOS2 that CiA 402 does not have; 0 = the drive has none (facts canopen 2.2; lengths
/// [unverified]).
struct PowerTimes {
  double start_s = 0.0;      ///< after power-on and reset: status word 0
  double not_ready_s = 0.0;  ///< then
  double refresh_s = 0.0;    ///< power stage refresh, at the first enable after that
  double measure_s = 0.0;    ///< then: measure init
};

enum class PowerExtra : std::int8_t { kNone, kStart, kRefresh, kMeasure };

class PowerStage {
 public:
  /// Braking ends when slower than this, or after this long [design choice].
  static constexpr double kSlow_rad_s = 0.05;
  static constexpr double kBrakeTime_s = 0.1;

  PowerStage(const PowerTimes& times, double step_s) noexcept;

  /// Power on, or NMT reset node.
  void reset() noexcept;
  /// @param fault_reset_allowed false: a rising edge of bit 7 is ignored, since the fault's cause is still
  /// there.
  void control(std::uint16_t word, const PowerOptions& options, double velocity_rad_s,
               bool fault_reset_allowed) noexcept;
  /// @param brakes with power, before the fault state; else power off at once.
  void fault(bool brakes, double velocity_rad_s) noexcept;
  /// What 0x6007 says (facts canopen 2.6): 0 nothing, 1 fault, 2 disable voltage, 3 quick stop. A drive
  /// without voltage stays as it is.
  void connection_lost(int abort_option, const PowerOptions& options, double velocity_rad_s) noexcept;
  /// Transitions that the drive makes by itself; once a tick.
  void advance(double velocity_rad_s) noexcept;

  PowerState state() const noexcept { return state_; }
  PowerExtra extra() const noexcept { return extra_; }
  bool in_fault() const noexcept {
    return state_ == PowerState::kFault || state_ == PowerState::kFaultReactionActive;
  }
  /// The motor may get current.
  bool powered() const noexcept;
  /// The motor is to be stopped, whatever the set-points say.
  bool braking() const noexcept;

 private:
  bool has_voltage() const noexcept;
  void leave_operation(PowerState target, bool brakes, double velocity_rad_s) noexcept;
  void quick_stop(const PowerOptions& options, double velocity_rad_s) noexcept;
  void begin_enable() noexcept;
  void advance_extra() noexcept;
  void advance_braking(double velocity_rad_s) noexcept;
  void enter(PowerState state) noexcept;

  PowerTimes times_;
  double step_s_;
  PowerState state_ = PowerState::kNotReadyToSwitchOn;
  PowerState after_braking_ = PowerState::kUnknown;  ///< operation is still shown, but ends there; kUnknown =
                                                     ///< it does not end
  PowerExtra extra_ = PowerExtra::kNone;
  std::uint16_t last_word_ = 0;
  bool halted_ = false;
  bool brakes_in_fault_ = false;
  bool stays_in_quick_stop_ = false;
  bool measured_ = false;  ///< the first enable is over
  double elapsed_s_ = 0.0;
};

}  // namespace sprung::sim
