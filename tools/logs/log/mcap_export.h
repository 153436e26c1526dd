#pragma once
/// A log as an MCAP file. Shell: reads a file.
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

/// A channel becomes a topic, a type a schema; messages are protocol buffers, a schema is a FileDescriptorSet
/// (proto_schema.h). A message's log time is the robot's (timeline.h), counted on
/// from when the first event was received: what is to be played back; its publish time is when it was
/// received. LOG_METADATA also becomes metadata "sprung" and an attachment robot.yaml. The caller finishes
/// the writer.
McapResult export_mcap(Reader& reader, ChannelFilter& channels, McapWriter& writer,
                       const Progress& progress = {});

}  // namespace sprung::log
