#pragma once
/// What is in a log: one pass over the file, in the memory of its channels. Shell: reads a file.
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tools/logs/log/incidents.h"
#include "tools/logs/log/reader.h"
#include "tools/logs/recorder/gap_tracker.h"
#include "tools/logs/recorder/log_messages.h"

namespace sprung::log {

/// What a log holds of one channel.
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

struct LogInfo {
  std::string path;
  std::uint64_t bytes = 0;
  std::int64_t events = 0;
  std::int64_t begin_us = 0;   ///< UTC, when the first event was received
  double received_s = 0.0;     ///< from the earliest event to the latest, as received
  double duration_s = 0.0;     ///< robot's time
  std::int64_t went_back = 0;  ///< events that were received before the one in front of them
  std::size_t sessions = 0;
  std::map<std::string, ChannelReport, std::less<>> channels;
  std::vector<Incident> incidents;  ///< the first thousand of each kind
  std::int64_t incidents_left_out = 0;
  std::int64_t not_deterministic = 0;  ///< cycles of a lock-step run, see IncidentFinder
  std::int64_t without_answer = 0;     ///< the same
  std::vector<std::string> said;       ///< the same
  std::array<std::int64_t, kLegEventCount> leg_counts{};
  std::optional<sprung_msgs::log_metadata_t> metadata;  ///< the first one
  std::optional<sprung_msgs::log_end_t> end;            ///< the last one
  bool being_written = false;  ///< by somebody, when it was opened or read to its end
  std::uint64_t damages = 0;
  std::uint64_t skipped_bytes = 0;

  std::int64_t missing() const noexcept;  ///< cycles, all channels
};

/// Told now and then how many bytes of how many are done.
using Progress = std::function<void(std::uint64_t done, std::uint64_t all)>;
inline constexpr std::int64_t kEventsBetween = 65'536;  ///< of two calls of a Progress that reads fast

LogInfo collect_info(Reader& reader, const std::vector<std::string>& leg_names = {},
                     const Progress& progress = {});

/// Of a reader at the end of its file. Of a log that is still being written this is no damage: the rest is on
/// its way.
bool ends_inside_an_event(const Reader& reader) noexcept;

struct LogExtent;
/// Begin and end alone. Reads the whole file, and leaves the reader at its begin.
LogExtent extent_of(Reader& reader);

/// Where a log is asked of which robot it is: by then each of its processes has said so several times.
inline constexpr int kEventsToLookAt = 20'000;

/// The first LOG_METADATA among the first events. Leaves the reader at its begin.
std::optional<sprung_msgs::log_metadata_t> find_metadata(Reader& reader);

/// Who made a log, "0.1.0 (abc)"; "" where nobody says so.
std::string made_by(const std::optional<sprung_msgs::log_metadata_t>& metadata);

}  // namespace sprung::log
