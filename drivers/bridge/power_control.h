#pragma once
/// The 402 state machine of one drive, from the master's side: which control word to send now. On change at
/// once, else at 10 Hz, so that a lost frame is repaired. Sees when a drive gives up by itself. Pure.
#include <cstdint>

#include "drivers/cia402/words.h"

namespace sprung {

class PowerControl {
 public:
  /// @param target for this cycle. After at most 0.5 s of quick stop the voltage is taken away, whatever the
  /// drive says.
  void set_target(cia402::PowerTarget target, std::int64_t time_us) noexcept;
  /// Answer the drive's fault with reset edges for as long as this is called with true.
  void reset_faults(bool reset) noexcept;
  /// What the drive says now.
  void observe(PowerState state) noexcept;
  /// The next step sends, whether or not the word has changed.
  void resend() noexcept { sent_any_ = false; }
  /// @return true when `word` has to be sent now.
  bool step(PowerState state, std::int64_t time_us, std::uint16_t& word) noexcept;

  cia402::PowerTarget target() const noexcept { return target_; }
  /// Operation enabled was wanted and reached, and the drive left it without being told. Until
  /// reset_faults(true).
  bool lost_power() const noexcept { return lost_power_; }

 private:
  std::uint16_t next_word(PowerState state, std::int64_t time_us) noexcept;

  cia402::PowerTarget target_ = cia402::PowerTarget::kOff;
  std::int64_t quick_stop_since_us_ = 0;
  std::int64_t sent_us_ = 0;
  std::uint16_t sent_word_ = 0;
  bool sent_any_ = false;
  bool reset_faults_ = false;
  bool wanted_enabled_ = false;   ///< by the last step
  bool reached_enabled_ = false;  ///< since it has been wanted without a break
  bool lost_power_ = false;
};

}  // namespace sprung
