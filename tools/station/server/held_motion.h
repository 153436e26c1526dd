#pragma once
/// A motion that goes on only while somebody is there: who began it says so again and again, and so do we to
/// the planner; the motion ends in a stand when either stops (tools/operate/commands/held_motion.h is the
/// same for a terminal). Pure; times are the session's us.
#include <cstdint>
#include <vector>

#include "signals/operator.h"

namespace sprung::station {

class HeldMotion {
 public:
  static constexpr double kHold_s = 0.5;     ///< [design choice] four renewals may be lost
  static constexpr double kLetGo_s = 0.001;  ///< of the last word: over in the next cycle
  static constexpr std::int64_t kRenew_us = 100'000;
  /// [design choice] nothing heard of who holds: he is gone. Together with the hold, and with setting the
  /// feet, the robot stands within 2 s.
  static constexpr std::int64_t kGone_us = 500'000;

  /// Its command has been sent, with kHold_s.
  void begin(std::int64_t now_us) noexcept;
  void touch(std::int64_t now_us) noexcept { touched_us_ = now_us; }  ///< he is there
  /// The planner heard of it otherwise: a command for the same motion with a hold of its own.
  void renewed(std::int64_t now_us) noexcept { renew_us_ = now_us + kRenew_us; }
  /// Ends at once: the hold is over in the next cycle, then a stop.
  void let_go(std::int64_t now_us) noexcept;
  void forget() noexcept;  ///< it has ended by itself

  bool active() const noexcept { return active_; }
  /// Appends what the planner is to be told now.
  void step(std::int64_t now_us, std::vector<OperatorCommand>& say);

 private:
  static constexpr std::int64_t kNone = -1;
  bool active_ = false;
  std::int64_t touched_us_ = 0;
  std::int64_t renew_us_ = 0;
  bool last_word_ = false;        ///< a hold that is over at once is to be said
  std::int64_t stop_us_ = kNone;  ///< when a stop is to be said
};

}  // namespace sprung::station
