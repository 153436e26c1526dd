#pragma once
/// A log as an MCAP file. Shell: reads a file.
#include <string>
#include <vector>

#include "tools/logs/log/channel_filter.h"
#include "tools/logs/log/log_info.h"
#include "tools/logs/log/mcap_writer.h"
#include "tools/logs/log/reader.h"

namespace sprung::log {

struct McapResult {
  std::int64_t events = 0;
  std::int64_t written = 0;
  std::int64_t not_decoded = 0;  ///< of an unknown type, or no messages at all
};

/// A message that is no event's own.
struct McapAddition {
  McapMessageHead head;
  std::string data;
};

/// What stands in the file beside a log's own channels.
class McapAdditions {
 public:
  virtual ~McapAdditions() = default;
  virtual void begin(McapWriter& writer) = 0;  ///< schemas, channels, attachments
  /// With each event, also of channels that are left out. @param time_s the robot's, since the log's begin.
  /// @param begin_us UTC, of that begin.
  virtual std::vector<McapAddition> add(const Event& event, double time_s, std::int64_t begin_us) = 0;
  virtual std::vector<McapAddition> finish() = 0;  ///< at the end
  /// After finish(): what they lack. @param maker who made the log, "" = not known
  virtual std::vector<std::string> notes(const std::string& maker) const = 0;
};

/// A channel becomes a topic, a type a schema; messages are protocol buffers, a schema is a FileDescriptorSet
/// (proto_schema.h). A message's log time is the robot's (timeline.h), counted on
/// from when the first event was received: what is to be played back; its publish time is when it was
/// received. @param additions nullptr: none. LOG_METADATA also becomes metadata "sprung" and an attachment
/// robot.yaml. The caller finishes the writer.
McapResult export_mcap(Reader& reader, ChannelFilter& channels, McapWriter& writer,
                       const Progress& progress = {}, McapAdditions* additions = nullptr);

}  // namespace sprung::log
