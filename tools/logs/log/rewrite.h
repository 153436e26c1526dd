#pragma once
/// New logs out of old ones: a part of one, several in one, what can be saved of a damaged one. Events keep
/// their times and bytes, and get new numbers. LOG_METADATA always comes along; LOG_END, which counts the
/// events of the old file, never. Shell: reads and writes files.
#include <cstdint>
#include <string>
#include <vector>

#include "tools/logs/log/channel_filter.h"
#include "tools/logs/log/log_info.h"
#include "tools/logs/log/reader.h"
#include "tools/logs/log/time_span.h"
#include "tools/logs/log/writer.h"

namespace sprung::log {

struct RewriteResult {
  std::int64_t read = 0;      ///< events
  std::int64_t written = 0;   ///< events
  std::int64_t brought = 0;   ///< of `written`: LOG_METADATA that nobody asked for
  std::uint64_t bytes = 0;    ///< written
  std::int64_t refused = 0;   ///< of `read`: messages of a known type that are none, left out by repair()
  std::uint64_t damages = 0;  ///< of the old file or files
  std::uint64_t skipped_bytes = 0;
};

/// @throws std::invalid_argument where `out` is one of the logs that are read, by whatever path.
void refuse_same_file(const std::vector<std::string>& logs, const std::string& out);

/// The events of a span and of some channels.
RewriteResult copy_part(Reader& reader, const TimeSpan& span, ChannelFilter& filter, Writer& writer,
                        const Progress& progress = {});

/// All events in the order in which they were received; those of one log stay in their order. Each log is
/// read as a stream.
RewriteResult merge(const std::vector<std::string>& logs, Writer& writer, const Progress& progress = {});

/// Whole events; those of known types only if they can be decoded.
RewriteResult repair(Reader& reader, Writer& writer, const Progress& progress = {});

}  // namespace sprung::log
