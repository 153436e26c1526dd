#include "tools/logs/log/mcap_export.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "lcmtypes/channels.h"
#include "tools/logs/fields/decoder.h"
#include "tools/logs/log/proto_message.h"
#include "tools/logs/log/proto_schema.h"
#include "tools/logs/log/proto_types.h"
#include "tools/logs/log/timeline.h"

namespace sprung::log {

namespace {

constexpr std::int64_t kMessagesBetween = 16'384;  // of two calls of a Progress

std::uint64_t ns(double us) {
  constexpr double kLatest_us = 1.8e16;  // what the format's 64 bits of ns hold
  return us > 0.0 && us < kLatest_us ? static_cast<std::uint64_t>(std::llround(us)) * 1000 : 0;
}

/// Brings messages into the order of their log times: an event's robot time may go back a little where the
/// network or a lock-step run mixed it. One that is older than what has been written stays out of order.
/// Publish times rise within each topic, too, since readers keep both as time series (Rerun counts rows that
/// go back as a problem): a message that was received before the one in front of it has that one's.
class InOrder {
 public:
  explicit InOrder(McapWriter& writer) : writer_(writer) {}

  void add(const McapMessageHead& head, std::string_view data) {
    held_.push_back({head, count_++, std::string(data)});
    std::push_heap(held_.begin(), held_.end(), LaterFirst{});
    if (held_.size() > kHeld) write_first();
  }
  void finish() {
    while (!held_.empty()) write_first();
  }

 private:
  static constexpr std::size_t kHeld = 1024;  // messages; a cycle of pegasus has some 10, with CAN_TRACE 15

  struct Held {
    McapMessageHead head;
    std::uint64_t count = 0;  ///< equal times stay as they came
    std::string data;
  };
  struct LaterFirst {
    bool operator()(const Held& a, const Held& b) const noexcept {
      return std::tie(a.head.log_ns, a.count) > std::tie(b.head.log_ns, b.count);
    }
  };

  void write_first() {
    std::pop_heap(held_.begin(), held_.end(), LaterFirst{});
    const Held& first = held_.back();
    std::uint64_t& published_ns = newest_published_ns_[first.head.channel];
    published_ns = std::max(published_ns, first.head.publish_ns);
    writer_.add_message(first.head.channel, first.head.sequence, first.head.log_ns, published_ns, first.data);
    held_.pop_back();
  }

  McapWriter& writer_;
  std::vector<Held> held_;                                      ///< a heap
  std::map<std::uint16_t, std::uint64_t> newest_published_ns_;  ///< by topic
  std::uint64_t count_ = 0;
};

class Exporter {
 public:
  explicit Exporter(McapWriter& writer) : writer_(writer), messages_(writer) {}

  /// @return whether it was a message of a known type.
  bool add(const Event& event, const Timeline::Moment& moment, std::int64_t begin_us) {
    if (decoder_.open(event.data, event.size, message_) != fields::Fault::kNone) return false;
    Topic& topic = topic_of(std::string(event.channel), *message_.layout()->type);
    const bool frame = event.channel == channels::kLogMetadata;
    const double log_us = static_cast<double>(frame ? event.time_us : begin_us) +
                          (frame ? 0.0 : 1e6 * moment.time_s);
    messages_.add({topic.id, topic.sequence++, ns(log_us), ns(static_cast<double>(event.time_us))},
                  protos_.encode(message_, event.data, event.size));
    if (frame) note_metadata(event);
    return true;
  }
  void add(const std::vector<McapAddition>& additions) {
    for (const McapAddition& one : additions) messages_.add(one.head, one.data);
  }
  void finish() { messages_.finish(); }

 private:
  struct Topic {
    std::uint16_t id = 0;
    std::uint32_t sequence = 0;
  };

  /// A channel whose messages change their type gets a topic for each.
  Topic& topic_of(const std::string& channel, const fields::StructType& type) {
    const auto key = std::make_pair(channel, type.hash);
    const auto found = topics_.find(key);
    if (found != topics_.end()) return found->second;
    auto schema = schemas_.find(type.hash);
    if (schema == schemas_.end()) {
      const std::uint16_t id = writer_.add_schema(proto_name(type), "protobuf", proto_schema(type));
      schema = schemas_.emplace(type.hash, id).first;
    }
    return topics_.emplace(key, Topic{writer_.add_channel(schema->second, channel, "protobuf"), 0})
        .first->second;
  }

  void note_metadata(const Event& event) {
    const auto metadata = read_log_metadata(event.data, event.size);
    if (!metadata) return;
    writer_.add_metadata("sprung", {{"robot", metadata->robot},
                                    {"preset", metadata->preset},
                                    {"clock", metadata->clock},
                                    {"version", metadata->version},
                                    {"git_hash", metadata->git_hash},
                                    {"host", metadata->host},
                                    {"command_line", metadata->command_line}});
    writer_.add_attachment(ns(static_cast<double>(event.time_us)), "robot.yaml", "application/yaml",
                           metadata->robot_yaml);
  }

  McapWriter& writer_;
  InOrder messages_;
  fields::Decoder decoder_;
  fields::MessageView message_;
  ProtoMessages protos_;
  std::map<std::int64_t, std::uint16_t> schemas_;  ///< by fingerprint
  std::map<std::pair<std::string, std::int64_t>, Topic> topics_;
};

}  // namespace

McapResult export_mcap(Reader& reader, ChannelFilter& channels, McapWriter& writer, const Progress& progress,
                       McapAdditions* additions) {
  Exporter exporter(writer);
  if (additions != nullptr) additions->begin(writer);
  Timeline timeline;
  McapResult result;
  for (Event event; reader.next(event);) {
    const Timeline::Moment moment = timeline.next(event);
    if (++result.events % kMessagesBetween == 0 && progress) progress(reader.position(), reader.file_bytes());
    if (additions != nullptr) exporter.add(additions->add(event, moment.time_s, timeline.begin_us()));
    if (!channels.keeps(event.channel)) continue;
    ++(exporter.add(event, moment, timeline.begin_us()) ? result.written : result.not_decoded);
  }
  if (additions != nullptr) exporter.add(additions->finish());
  exporter.finish();
  return result;
}

}  // namespace sprung::log
