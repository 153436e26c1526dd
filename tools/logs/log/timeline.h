#pragma once
/// The robot's time through a log, in seconds since its first event other than LOG_METADATA. Pure.
///
/// An event's own time is when it was received: with the network's jitter, and in lock-step whatever the
/// computer took. So messages of channels with one message a cycle count by their stamp, each session joined
/// to the one before where it was first received, and what comes between them by how much later it was
/// received.
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>

#include "tools/logs/fields/type_table.h"
#include "tools/logs/log/event.h"

namespace sprung::log {

/// What every message of sprung begins with.
struct SessionStamp {
  std::int64_t session = 0;
  std::int64_t utime_us = 0;  ///< of the session; in lock-step the cycle's own time
  std::int64_t seq = -1;
};

/// Reads a message's stamp without decoding the rest.
class StampReader {
 public:
  explicit StampReader(const fields::TypeTable& types = fields::TypeTable::sprung()) : types_(types) {}

  /// Nothing where the type is unknown, or is one without a stamp.
  std::optional<SessionStamp> read(const std::uint8_t* data, std::size_t size);

 private:
  const fields::TypeTable& types_;
  std::unordered_map<std::int64_t, bool> stamped_;  ///< by fingerprint
};

class Timeline {
 public:
  explicit Timeline(const fields::TypeTable& types = fields::TypeTable::sprung()) : stamps_(types) {}

  struct Moment {
    double time_s = 0.0;                ///< since the first event; may go back a little where events do
    std::optional<SessionStamp> stamp;  ///< of the event's message
  };
  /// Of the next event: all events of the log, or at least all of the channels that matter, in their order.
  Moment next(const Event& event);

  /// When the first event was received, us UTC.
  std::int64_t begin_us() const noexcept { return begin_us_; }

 private:
  /// One instant by two clocks; in floating point, since a damaged message may say any number.
  struct Anchor {
    double time_s = 0.0;
    std::int64_t other_us = 0;
    double time_of_s(std::int64_t other) const noexcept {
      return time_s + (static_cast<double>(other) - static_cast<double>(other_us)) / 1e6;
    }
  };

  StampReader stamps_;
  bool begun_ = false;
  std::int64_t begin_us_ = 0;
  std::int64_t session_ = 0;
  std::optional<Anchor> robot_;  ///< of the session: from its utime
  Anchor received_;              ///< of the newest cyclic message: from when it was received
};

}  // namespace sprung::log
