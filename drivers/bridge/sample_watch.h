#pragma once
/// Which of one node's answers belongs to which SYNC, how old the newest is, and whether the node has fallen
/// silent. A device that stalls pays late and in order: answers that are owed are counted, so that neither a
/// late one nor a second device is taken for this cycle's. Pure; stepped by cycles.
#include <array>
#include <cstdint>

#include "drivers/can/can_frame.h"
#include "signals/bus_state.h"

namespace sprung {

/// What one more answer is.
enum class Answer : std::int8_t {
  kSample,    ///< to be read: the newest there is
  kRepeated,  ///< the bus has said it twice: harmless
  kConflict,  ///< another than this SYNC's, and none was owed: two devices
  kUnasked,   ///< late, and nobody knows what it answers
};

class SampleWatch {
 public:
  /// @param silent_cycles as WatchdogConfig.
  explicit SampleWatch(int silent_cycles) noexcept : silent_cycles_(silent_cycles) {}

  /// SYNC goes out. @param owes the node is in operation, and so owes an answer.
  void begin(std::int64_t sync_us, bool owes) noexcept;
  /// @param time_us when it was received, by the kernel's stamp.
  Answer receive(const CanFrame& frame, std::int64_t time_us) noexcept;
  /// An answer has come that nobody has judged: to this SYNC, or since the last end() to an older one.
  bool to_be_judged() const noexcept { return answered_ || heard_late_; }
  /// @param accepted the answer to be judged is a new measurement. @param owes as in begin().
  void end(bool accepted, bool owes) noexcept;
  void begin_operation() noexcept { age_cycles_ = untimely_cycles_ = 0; }
  /// Its communication is reset: it owes nothing.
  void restart() noexcept;

  bool answered() const noexcept { return answered_; }  ///< this SYNC
  /// Answered, and no more answers are on their way as far as one can tell: one that was silent may send
  /// older ones first.
  bool caught_up() const noexcept { return answered_ && !(catching_up_ && owed_ > 0); }
  int owed() const noexcept { return owed_; }  ///< answers that have not come, as far as they may still come
  int age_cycles() const noexcept { return age_cycles_; }  ///< of the newest answer
  /// In a row without an answer in time.
  int untimely_cycles() const noexcept { return untimely_cycles_; }
  bool too_old() const noexcept { return age_cycles_ > silent_cycles_; }
  /// The newest answer is too old, or for twice that long none came in its cycle.
  bool silent() const noexcept;

  /// Of this cycle.
  std::int64_t sync_us() const noexcept { return sync_us_; }
  /// Of the cycle that the answer counts for: the one before, when it came after that was over.
  std::int64_t sample_sync_us() const noexcept { return answered_ ? sync_us_ : last_sync_us_; }
  /// Of the oldest SYNC that this cycle's answer may belong to: answers come in order, and those that are
  /// owed may be lost, or still to come. None is older than the silence that a node is allowed.
  std::int64_t earliest_sync_us() const noexcept;

  void count_missing(int samples) noexcept { missing_ += samples; }
  /// Missing, late and duplicate samples.
  void show(NodeHealth& out) const noexcept;

 private:
  bool is_newer(const CanFrame& frame) const noexcept { return !(frame == answer_) && owed_ > 0; }

  static constexpr int kMostOwed = 64;  ///< [design choice] more would hide a second device for long

  int silent_cycles_;
  std::int64_t sync_us_ = 0;
  std::int64_t last_sync_us_ = 0;
  std::array<std::int64_t, kMostOwed> syncs_us_{};  ///< of the last cycles, a ring
  std::int64_t syncs_ = 0;
  CanFrame answer_;        ///< the newest one to this SYNC
  bool sampling_ = false;  ///< between begin() and end()
  bool answered_ = false;
  int owed_ = 0;
  int answers_ = 0;           ///< since this SYNC, to whichever
  bool catching_up_ = false;  ///< it owes answers, and did not send just one in the last cycle
  int punctual_cycles_ = 0;   ///< in a row that were answered
  int age_cycles_ = 0;
  int untimely_cycles_ = 0;
  bool heard_late_ = false;  ///< an answer has come since the last cycle was over, to an older SYNC
  std::int64_t missing_ = 0;
  std::int64_t late_ = 0;
  std::int64_t duplicate_ = 0;
};

}  // namespace sprung
