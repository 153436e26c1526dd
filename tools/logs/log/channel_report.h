#pragma once
/// What a log holds of one channel. Pure.
#include <cstdint>
#include <limits>
#include <string>

#include "tools/logs/log/event.h"
#include "tools/logs/log/timeline.h"
#include "tools/logs/recorder/gap_tracker.h"

namespace sprung::log {

struct ChannelReport {
  std::string type;  ///< "drive_state_t"; "" = unknown here; "several types" where messages differ
  std::int64_t messages = 0;
  std::uint64_t bytes = 0;  ///< of the messages alone
  double first_s = 0.0;     ///< robot's time, see timeline.h
  double last_s = 0.0;
  double longest_pause_s = 0.0;  ///< between two messages
  double longest_pause_at_s = 0.0;
  bool cyclic = false;  ///< one message a cycle: only then a missing one can be told
  GapCounts cycles;     ///< of a cyclic channel

  /// Messages a second on average, repeats not counted; NaN of fewer than two.
  double rate_Hz() const noexcept;
};

class ChannelCounter {
 public:
  ChannelCounter(std::string_view channel, const fields::TypeTable& types);
  void add(const Event& event, const Timeline::Moment& moment);
  ChannelReport report() const;

 private:
  void note_type(const Event& event);

  const fields::TypeTable& types_;
  ChannelReport report_;
  std::int64_t hash_ = 0;
  SessionGapTracker cycles_;
};

}  // namespace sprung::log
