#pragma once
/// Node guarding of one node (CiA 301 7.2.8.3.2.1): the bridge asks by a remote frame, the node answers with
/// its NMT state and a bit that toggles from answer to answer. For nodes that have no heartbeat
/// (robot.yaml `watch: guarding`). Pure; stepped by time.
#include <cstdint>

#include "drivers/canopen/nmt.h"

namespace sprung {

class GuardWatch {
 public:
  /// @param guarded false: nothing is ever due, and every answer is taken: it is a heartbeat.
  GuardWatch(bool guarded, std::int64_t period_us) noexcept : guarded_(guarded), period_us_(period_us) {}

  bool guarded() const noexcept { return guarded_; }
  /// From now on, as the node was found to need; the bits of its answers begin anew.
  void set_guarded(bool guarded) noexcept {
    if (guarded_ != guarded) restart();
    guarded_ = guarded;
  }
  /// The node's communication was reset: its next answer has toggle 0.
  void restart() noexcept;
  /// Once a cycle while the node is to be watched. @param cycle_us questions come rather early than late, so
  /// that the node's life time holds. @return whether a question goes out now.
  bool due(std::int64_t time_us, std::int64_t cycle_us) noexcept;
  /// An answer, or a boot-up. @return false where its toggle bit is the last answer's, and no question
  /// between them was left unanswered: then it says nothing about the node, and counts as missing.
  bool answered(const canopen::GuardReply& reply) noexcept;

  /// The last answer had the wrong toggle bit.
  bool toggle_stands() const noexcept { return wrong_; }
  std::int64_t toggle_errors() const noexcept { return errors_; }

 private:
  bool guarded_;
  std::int64_t period_us_;
  std::int64_t next_us_ = 0;
  int unanswered_ = 0;     ///< questions since the last answer
  bool either_ = false;    ///< the next answer may have either bit
  bool expected_ = false;  ///< toggle bit of the next answer
  bool wrong_ = false;
  std::int64_t errors_ = 0;
};

}  // namespace sprung
