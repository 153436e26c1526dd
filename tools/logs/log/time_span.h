#pragma once
/// A stretch of a log as people write it: from and to, each in seconds since the log's begin ("12.5"), before
/// its end ("-5"), or as a time of day ("2026-11-21T20:00:00.25Z", UTC) or a unix time ("@1795291200.25").
/// Pure.
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

namespace sprung::log {

struct TimePoint {
  enum class Kind : std::int8_t { kSinceBegin, kBeforeEnd, kUtc };
  Kind kind = Kind::kSinceBegin;
  double seconds = 0.0;     ///< of kSinceBegin, and of kBeforeEnd, >= 0
  std::int64_t utc_us = 0;  ///< of kUtc
};

/// @throws std::invalid_argument naming the text and the ways to write it.
TimePoint parse_time(const std::string& text);

/// Where a log's own times lie, to make sense of a TimePoint.
struct LogExtent {
  std::int64_t begin_us = 0;  ///< UTC of its first event
  double end_s = 0.0;         ///< of its last, since the first
};

struct TimeSpan {
  std::optional<TimePoint> from;  ///< nothing: the log's begin
  std::optional<TimePoint> to;    ///< nothing: the log's end; that moment itself is left out

  /// Whether the end of the log must be known before the first event can be judged.
  bool needs_end() const noexcept;
  bool everything() const noexcept { return !from && !to; }
};

/// @param from, to "" = nothing. @throws std::invalid_argument as parse_time, and where `to` surely comes
/// before `from`.
TimeSpan parse_span(const std::string& from, const std::string& to);

/// The span on the log's own scale: an absolute time counts by when messages were received, all others by the
/// robot's time.
class SpanTest {
 public:
  SpanTest(const TimeSpan& span, const LogExtent& extent) noexcept;
  bool holds(double time_s, std::int64_t received_us) const noexcept;

 private:
  double from_s_ = -std::numeric_limits<double>::infinity();
  double to_s_ = std::numeric_limits<double>::infinity();
  std::int64_t from_us_ = std::numeric_limits<std::int64_t>::min();
  std::int64_t to_us_ = std::numeric_limits<std::int64_t>::max();
};

}  // namespace sprung::log
